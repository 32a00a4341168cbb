// The only file that knows CLI11: what commands declare becomes its options, and its errors become sentences.
#include "command_line.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <memory>

#include "boxwood/error.h"
#include "command.h"
#include "console.h"
#include "exit_code.h"
#include "options/suggest.h"

namespace boxwood::cli {
namespace {

/// Every command, in the order of the help. A new one is a line here and its declaration in command.h.
constexpr void (*all_commands[])(CommandSet&) = {
    // clang-format off
    add_render,
    add_advise,
    add_compare,
    add_build,
    add_inspect,
    add_verify,
    add_animate,
    add_view_command,
    add_cameras,
    add_video,
    add_soak,
    add_test,
    add_bench,
    add_study,
    add_results,
    add_report,
    add_recipes,
    add_scenes,
    // clang-format on
};

void show_default(CLI::Option* option, const std::string& shown_default) {
  if (shown_default.empty()) {
    option->capture_default_str();
  } else {
    option->default_str(shown_default);
  }
}

const CLI::App& chosen(const CLI::App& app) {
  const auto commands = app.get_subcommands();
  return commands.empty() ? app : *commands.front();
}

/// What could have been meant by an argument that nobody took.
std::string hint(const CLI::App& app, const std::string& wrong) {
  std::vector<std::string> names;
  if (wrong.starts_with("-")) {
    for (const CLI::Option* option : app.get_options()) {
      if (!option->get_positional()) names.push_back(option->get_name());
    }
    return fmt::format("there is no option '{}'; {}", wrong, suggest(wrong.substr(0, wrong.find('=')), names));
  }
  for (const CLI::App* command : app.get_subcommands([](const CLI::App*) { return true; })) {
    names.push_back(command->get_name());
  }
  if (names.empty()) return fmt::format("'{}' is one argument too many", wrong);
  return fmt::format("there is no command '{}'; {}", wrong, suggest(wrong, names));
}

[[noreturn]] void explain(const CLI::App& app, const CLI::ParseError& error) {
  const CLI::App& command = chosen(app);
  const std::string where = &command == &app ? "" : fmt::format("{}: ", command.get_name());
  if (error.get_exit_code() == static_cast<int>(CLI::ExitCodes::ExtrasError)) {
    throw UsageError(fmt::format("{}{}", where, hint(command, app.remaining(true).front())));
  }
  throw UsageError(fmt::format("{}{}; see 'boxwood {}--help'", where, error.what(),
                               &command == &app ? "" : fmt::format("{} ", command.get_name())));
}

std::function<int()> printing(std::string text) {
  return [text = std::move(text)] {
    print(text);
    return exit_done;
  };
}

}  // namespace

void Command::flag(const std::string& names, bool& target, const std::string& help) {
  app_->add_flag(names, target, help);
}

void Command::text(const std::string& names, std::string& target, const std::string& type, const std::string& help,
                   const std::string& shown_default) {
  show_default(app_->add_option(names, target, help)->type_name(type), shown_default);
}

void Command::integer(const std::string& names, std::uint32_t& target, std::uint32_t low, std::uint32_t high,
                      const std::string& help, const std::string& shown_default) {
  show_default(app_->add_option(names, target, help)->type_name("N")->check(CLI::Range(low, high)), shown_default);
}

void Command::real(const std::string& names, double& target, double low, double high, const std::string& help) {
  show_default(app_->add_option(names, target, help)->type_name("X")->check(CLI::Range(low, high)), "");
}

void Command::choice(const std::string& names, std::string& target, const std::vector<std::string>& choices,
                     const std::string& type, const std::string& help) {
  app_->add_option(names, target, help)->type_name(type)->check(CLI::IsMember(choices))->capture_default_str();
}

void Command::repeated(const std::string& names, std::vector<std::string>& target, const std::string& type,
                       const std::string& help) {
  app_->add_option(names, target, help)->type_name(type)->expected(1)->take_all();
}

void Command::list(const std::string& names, std::vector<std::string>& target, const std::string& type,
                   const std::string& help, const std::string& shown_default) {
  app_->add_option(names, target, help)
      ->type_name(type)
      ->delimiter(',')
      ->allow_extra_args(false)
      ->default_str(shown_default);
}

void Command::parsed(const std::string& names, std::function<void(const std::string&)> parse, const std::string& type,
                     const std::string& help, const std::string& shown_default) {
  const auto checked = [names, parse = std::move(parse)](const std::string& text) {
    try {
      parse(text);
    } catch (const UsageError& error) {
      throw CLI::ValidationError(names, error.what());
    }
  };
  app_->add_option_function<std::string>(names, checked, help)->type_name(type)->default_str(shown_default);
}

void Command::argument(const std::string& name, std::string& target, const std::string& help, bool optional) {
  app_->add_option(name, target, help)->required(!optional)->type_name("");
}

void Command::arguments(const std::string& name, std::vector<std::string>& target, const std::string& help) {
  app_->add_option(name, target, help)->required()->type_name("…");
}

void Command::conflict(const std::string& name, const std::string& other) {
  app_->get_option(name)->excludes(app_->get_option(other));
}

Command CommandSet::add(const std::string& name, const std::string& summary, std::function<int()> run) {
  CLI::App* added = app_.add_subcommand(name, summary);
  added->callback([&chosen = chosen_, run = std::move(run)] { chosen = run; });
  return Command(*added);
}

std::function<int()> parse_command_line(int count, const char* const* arguments) {
  CLI::App app("Boxwood: which acceleration structure should trace this scene, for these rays?", "boxwood");
  app.set_version_flag("--version", "boxwood " BOXWOOD_VERSION);
  app.require_subcommand(0, 1);
  std::function<int()> command;
  CommandSet commands(app, command);
  for (const auto add : all_commands) add(commands);
  try {
    app.parse(count, arguments);
  } catch (const CLI::CallForHelp&) {
    return printing(app.help());
  } catch (const CLI::CallForVersion& asked) {
    return printing(fmt::format("{}\n", asked.what()));
  } catch (const CLI::ParseError& error) {
    explain(app, error);
  }
  return command ? command : printing(app.help());
}

}  // namespace boxwood::cli
