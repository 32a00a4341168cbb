#include "options/options.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>

namespace boxwood::option_text {
namespace {

template <class T>
T parse_number(std::string_view text, T low, T high, std::string_view what) {
  T value{};
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc{} || end != text.data() + text.size() || !(value >= low && value <= high)) {
    throw UsageError(fmt::format("takes {} from {} to {}, not '{}'", what, low, high, text));
  }
  return value;
}

}  // namespace

std::uint32_t parse_integer(std::string_view text, std::uint32_t low, std::uint32_t high) {
  return parse_number(text, low, high, "a whole number");
}

float parse_real(std::string_view text, float low, float high) { return parse_number(text, low, high, "a number"); }

bool parse_flag(std::string_view text) {
  if (text == "on" || text == "off") return text == "on";
  throw UsageError(fmt::format("takes on or off, not '{}'", text));
}

std::size_t parse_choice(std::string_view text, std::span<const std::string> names) {
  const auto found = std::find(names.begin(), names.end(), text);
  if (found == names.end()) throw UsageError(fmt::format("takes one of {}, not '{}'", join(names, ", "), text));
  return static_cast<std::size_t>(found - names.begin());
}

std::string print_real(float value) { return fmt::format("{}", value); }

std::string join(std::span<const std::string> names, std::string_view separator) {
  return fmt::format("{}", fmt::join(names, separator));
}

}  // namespace boxwood::option_text
