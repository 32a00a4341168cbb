#pragma once
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace boxwood::testing {

struct Outcome {
  int exit_code = -1;  ///< negative: died of that signal
  std::string out, err;
};

/// Starts the boxwood program in `folder`. `interrupt_after_ms` > 0 sends Ctrl-C then, counted
/// from when it is caught. `out_file` takes standard output
/// instead of Outcome::out.
struct RunOptions {
  std::filesystem::path folder = ".";
  unsigned interrupt_after_ms = 0;
  bool kill = false;  ///< sends SIGKILL instead of Ctrl-C
  std::string out_file = {};
};
Outcome run_boxwood(const std::vector<std::string>& arguments, const RunOptions& options = {});

/// Runs in `folder` with --json; checks that it succeeds, says nothing else, and prints one document.
nlohmann::json run_for_json(std::vector<std::string> arguments, const std::filesystem::path& folder = ".");

std::string read_file(const std::filesystem::path& file);
void write_file(const std::filesystem::path& file, const std::string& text);

/// An empty folder that goes when the test does.
class TemporaryFolder {
 public:
  TemporaryFolder();
  ~TemporaryFolder();
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;

  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

/// `arguments` and then `more`.
inline std::vector<std::string> with(std::vector<std::string> arguments, const std::vector<std::string>& more) {
  arguments.insert(arguments.end(), more.begin(), more.end());
  return arguments;
}

}  // namespace boxwood::testing
