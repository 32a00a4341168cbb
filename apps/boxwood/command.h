#pragma once
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

namespace CLI {
class App;
}

namespace boxwood::cli {

/// Declares what one command takes. Targets must live as long as the function given to CommandSet::add; their values
/// are the defaults that the help shows, unless `shown_default` says it better. `names` are as in "-o,--output".
/// CLI11 is behind it and stays there, because it takes ten seconds to compile.
class Command {
 public:
  explicit Command(CLI::App& app) : app_(&app) {}

  void flag(const std::string& names, bool& target, const std::string& help);
  void text(const std::string& names, std::string& target, const std::string& type, const std::string& help,
            const std::string& shown_default = "");
  void integer(const std::string& names, std::uint32_t& target, std::uint32_t low, std::uint32_t high,
               const std::string& help, const std::string& shown_default = "");
  void real(const std::string& names, double& target, double low, double high, const std::string& help);
  void choice(const std::string& names, std::string& target, const std::vector<std::string>& choices,
              const std::string& type, const std::string& help);
  /// Said once for each value.
  void repeated(const std::string& names, std::vector<std::string>& target, const std::string& type,
                const std::string& help);
  /// A comma-separated list.
  void list(const std::string& names, std::vector<std::string>& target, const std::string& type,
            const std::string& help, const std::string& shown_default);
  /// `parse` throws UsageError("takes …, not '…'") on a bad text.
  void parsed(const std::string& names, std::function<void(const std::string& text)> parse, const std::string& type,
              const std::string& help, const std::string& shown_default);
  /// What stands without a name; in the order in which they are declared. Required unless `optional`.
  void argument(const std::string& name, std::string& target, const std::string& help, bool optional = false);
  void arguments(const std::string& name, std::vector<std::string>& target, const std::string& help);
  /// Two options that cannot both be given.
  void conflict(const std::string& name, const std::string& other);

 private:
  CLI::App* app_;
};

/// The commands of the program. Each is added by a function of its own, listed in command_line.cpp.
class CommandSet {
 public:
  CommandSet(CLI::App& app, std::function<int()>& chosen) : app_(app), chosen_(chosen) {}

  /// `run` returns the exit code and throws Error or UsageError. It owns the command's options: capture a shared_ptr.
  Command add(const std::string& name, const std::string& summary, std::function<int()> run);

 private:
  CLI::App& app_;
  std::function<int()>& chosen_;
};

// One function per command, defined where the command is.
void add_render(CommandSet& commands);
void add_build(CommandSet& commands);
void add_compare(CommandSet& commands);
void add_advise(CommandSet& commands);
void add_inspect(CommandSet& commands);
void add_animate(CommandSet& commands);
void add_verify(CommandSet& commands);
void add_cameras(CommandSet& commands);
void add_bench(CommandSet& commands);
void add_study(CommandSet& commands);
void add_results(CommandSet& commands);
void add_report(CommandSet& commands);
void add_recipes(CommandSet& commands);
void add_scenes(CommandSet& commands);
void add_view_command(CommandSet& commands);
void add_video(CommandSet& commands);
void add_soak(CommandSet& commands);
void add_test(CommandSet& commands);

}  // namespace boxwood::cli
