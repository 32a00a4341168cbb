#include "options/call.h"

#include <fmt/format.h>

#include <algorithm>

#include "options/suggest.h"

namespace boxwood {
namespace {

const Option& find_option(std::string_view owner, std::span<const Option> described, std::string_view name) {
  std::vector<std::string> names;
  for (const Option& option : described) {
    if (option.name == name) return option;
    names.push_back(option.name);
  }
  if (names.empty()) throw UsageError(fmt::format("'{}' takes no options, so not '{}'", owner, name));
  throw UsageError(fmt::format("'{}' has no option '{}'; {}", owner, name, suggest(name, names)));
}

const Option& positional_option(std::string_view owner, std::span<const Option> described, std::string_view value) {
  const auto found = std::find_if(described.begin(), described.end(), [](const Option& o) { return o.positional; });
  if (found != described.end()) return *found;
  throw UsageError(fmt::format("'{}' needs its options by name, as in {}(name=value), not '{}'", owner, owner, value));
}

}  // namespace

std::string_view trim(std::string_view text) {
  const auto first = text.find_first_not_of(" \t\r\n");
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(" \t\r\n") - first + 1);
}

CallText parse_call_text(std::string_view text) {
  text = trim(text);
  const auto open = text.find('(');
  CallText call{trim(text.substr(0, open)), {}};
  const bool closed = open != std::string_view::npos && text.find(')') + 1 == text.size() &&
                      text.find('(', open + 1) == std::string_view::npos;
  if (open == std::string_view::npos ? text.find(')') != std::string_view::npos : !closed) {
    throw UsageError(
        fmt::format("'{}' must have its options in one pair of parentheses, as in {}(name=value)", text, call.name));
  }
  if (open == std::string_view::npos) return call;
  std::string_view rest = trim(text.substr(open + 1, text.size() - open - 2));
  while (!rest.empty()) {
    const auto comma = rest.find(',');
    call.arguments.push_back(trim(rest.substr(0, comma)));
    rest = comma == std::string_view::npos ? std::string_view{} : rest.substr(comma + 1);
  }
  return call;
}

void set_option(std::string_view owner, std::span<const Option> described, std::any& options,
                std::string_view argument) {
  const auto equals = argument.find('=');
  const bool named = equals != std::string_view::npos;
  const Option& option = named ? find_option(owner, described, trim(argument.substr(0, equals)))
                               : positional_option(owner, described, argument);
  try {
    option.set(options, named ? trim(argument.substr(equals + 1)) : argument);
  } catch (const UsageError& error) {
    throw UsageError(fmt::format("option '{}' of '{}' {}", option.name, owner, error.what()));
  }
}

}  // namespace boxwood
