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

/// The option that the unnamed argument number `unnamed` stands for.
const Option& positional_option(std::string_view owner, std::span<const Option> described, std::string_view value,
                                std::size_t unnamed) {
  for (const Option& option : described) {
    if (option.positional && unnamed-- == 0) return option;
  }
  throw UsageError(fmt::format("'{}' needs its options by name, as in {}(name=value), not '{}'", owner, owner, value));
}

/// Where the first `wanted` stands that is in no parentheses; npos when there is none.
std::size_t find_outside(std::string_view text, char wanted) {
  int depth = 0;
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (text[i] == wanted && depth == 0) return i;
    depth += text[i] == '(' ? 1 : text[i] == ')' ? -1 : 0;
  }
  return std::string_view::npos;
}

/// Whether the parenthesis at `open` is closed by the last character and not before.
bool closes_at_end(std::string_view text, std::size_t open) {
  int depth = 0;
  for (std::size_t i = open; i < text.size(); ++i) {
    depth += text[i] == '(' ? 1 : text[i] == ')' ? -1 : 0;
    if (depth == 0) return i + 1 == text.size();
  }
  return false;
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
  if (open == std::string_view::npos ? text.find(')') != std::string_view::npos : !closes_at_end(text, open)) {
    throw UsageError(
        fmt::format("'{}' must have its options in one pair of parentheses, as in {}(name=value)", text, call.name));
  }
  if (open == std::string_view::npos) return call;
  std::string_view rest = trim(text.substr(open + 1, text.size() - open - 2));
  while (!rest.empty()) {
    const auto comma = find_outside(rest, ',');
    call.arguments.push_back(trim(rest.substr(0, comma)));
    rest = comma == std::string_view::npos ? std::string_view{} : rest.substr(comma + 1);
  }
  return call;
}

void set_option(std::string_view owner, std::span<const Option> described, std::any& options, std::string_view argument,
                std::size_t unnamed) {
  const auto equals = find_outside(argument, '=');
  const bool named = equals != std::string_view::npos;
  const Option& option = named ? find_option(owner, described, trim(argument.substr(0, equals)))
                               : positional_option(owner, described, argument, unnamed);
  try {
    option.set(options, named ? trim(argument.substr(equals + 1)) : argument);
  } catch (const UsageError& error) {
    throw UsageError(fmt::format("option '{}' of '{}' {}", option.name, owner, error.what()));
  }
}

void set_options(std::span<const Option> described, std::any& options, const CallText& call) {
  std::size_t unnamed = 0;
  for (const std::string_view argument : call.arguments) {
    set_option(call.name, described, options, argument, unnamed);
    if (find_outside(argument, '=') == std::string_view::npos) ++unnamed;
  }
}

}  // namespace boxwood
