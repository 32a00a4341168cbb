#pragma once
#include <any>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "options/options.h"

namespace boxwood {

std::string_view trim(std::string_view text);

/// "NAME" or "NAME(argument, …)" taken apart. Parts refer to the text and are trimmed. Arguments may be calls
/// themselves.
struct CallText {
  std::string_view name;
  std::vector<std::string_view> arguments;
};

/// Throws UsageError when the parentheses are not one closed pair at the end.
CallText parse_call_text(std::string_view text);

/// Sets the option that `argument` ("name=value", or "value" for a positional one) speaks of; `unnamed` arguments
/// without a name came before it. Throws UsageError naming `owner`, the option, and what would be valid.
void set_option(std::string_view owner, std::span<const Option> described, std::any& options, std::string_view argument,
                std::size_t unnamed = 0);
/// Sets all that the call speaks of.
void set_options(std::span<const Option> described, std::any& options, const CallText& call);

}  // namespace boxwood
