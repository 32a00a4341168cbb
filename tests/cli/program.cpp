#include "cli/program.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <stdexcept>
#include <thread>

namespace boxwood::testing {
namespace {

namespace fs = std::filesystem;

/// Between fork and exec only calls that are safe there.
[[noreturn]] void become_boxwood(std::vector<char*>& arguments, const char* folder, const char* out, const char* err) {
  const auto redirect = [](const char* file, int to) {
    const int from = open(file, O_WRONLY | O_CREAT | O_TRUNC, 0600);
    if (from < 0 || dup2(from, to) < 0) _exit(126);
    close(from);
  };
  redirect(out, STDOUT_FILENO);
  redirect(err, STDERR_FILENO);
  if (chdir(folder) != 0) _exit(126);
  execv(arguments[0], arguments.data());
  _exit(127);
}

/// Whether the process has a handler for Ctrl-C, which a program that is still being loaded has not.
bool catches_interrupts(pid_t process) {
  std::ifstream status("/proc/" + std::to_string(process) + "/status");
  for (std::string line; std::getline(status, line);) {
    if (line.starts_with("SigCgt:")) return std::stoull(line.substr(7), nullptr, 16) >> (SIGINT - 1) & 1;
  }
  return false;
}

void interrupt(pid_t process, const RunOptions& options) {
  using namespace std::chrono_literals;
  for (int tries = 0; !options.kill && !catches_interrupts(process) && tries < 6000; ++tries) {
    std::this_thread::sleep_for(10ms);
  }
  std::this_thread::sleep_for(std::chrono::milliseconds(options.interrupt_after_ms));
  kill(process, options.kill ? SIGKILL : SIGINT);
}

}  // namespace

std::string read_file(const fs::path& file) {
  std::ifstream stream(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

void write_file(const fs::path& file, const std::string& text) { std::ofstream(file, std::ios::binary) << text; }

TemporaryFolder::TemporaryFolder() {
  std::string pattern = (fs::temp_directory_path() / "boxwood-cli-XXXXXX").string();
  if (!mkdtemp(pattern.data())) throw std::runtime_error("no temporary folder");
  path_ = pattern;
}

TemporaryFolder::~TemporaryFolder() {
  std::error_code ignored;
  fs::remove_all(path_, ignored);
}

Outcome run_boxwood(const std::vector<std::string>& arguments, const RunOptions& options) {
  const TemporaryFolder streams;
  const std::string out = options.out_file.empty() ? (streams.path() / "out").string() : options.out_file;
  const std::string err = (streams.path() / "err").string();
  const std::string folder = options.folder.string();
  std::vector<std::string> words = {BOXWOOD_BINARY};
  words.insert(words.end(), arguments.begin(), arguments.end());
  std::vector<char*> pointers;
  for (std::string& word : words) pointers.push_back(word.data());
  pointers.push_back(nullptr);

  const pid_t child = fork();
  if (child == 0) become_boxwood(pointers, folder.c_str(), out.c_str(), err.c_str());
  if (child < 0) throw std::runtime_error("fork failed");
  if (options.interrupt_after_ms > 0) interrupt(child, options);
  int status = 0;
  waitpid(child, &status, 0);
  Outcome outcome;
  outcome.exit_code = WIFEXITED(status) ? WEXITSTATUS(status) : -WTERMSIG(status);
  if (options.out_file.empty()) outcome.out = read_file(out);
  outcome.err = read_file(err);
  return outcome;
}

nlohmann::json run_for_json(std::vector<std::string> arguments, const fs::path& folder) {
  arguments.push_back("--json");
  const Outcome outcome = run_boxwood(arguments, {.folder = folder});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_EQ(outcome.err, "");
  nlohmann::json document = nlohmann::json::parse(outcome.out, nullptr, false);
  EXPECT_FALSE(document.is_discarded()) << outcome.out;
  return document;
}

}  // namespace boxwood::testing
