#include "report/number_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>

namespace boxwood {
namespace {

/// Digits after the point that show `digits` significant ones.
int decimals_for(double value, int digits) {
  const double size = std::fabs(value);
  if (!(size > 0) || !std::isfinite(size)) return 0;
  // Rounding may carry into a new digit, as 9.996 does at three, so count after it.
  const auto exponent = [](double number) { return static_cast<int>(std::floor(std::log10(number))); };
  const double unit = std::pow(10.0, exponent(size) - digits + 1);
  return std::clamp(digits - 1 - exponent(std::round(size / unit) * unit), 0, 12);
}

/// Commas between every three of the first `whole` characters, counted from their end.
std::string with_commas(std::string_view digits, std::size_t whole) {
  std::string out;
  for (std::size_t i = 0; i < digits.size(); ++i) {
    if (i > 0 && i < whole && (whole - i) % 3 == 0) out += ',';
    out += digits[i];
  }
  return out;
}

std::string fixed(double value, int decimals) {
  if (!std::isfinite(value)) return "–";
  const std::string digits = fmt::format("{:.{}f}", std::fabs(value), decimals);
  return fmt::format("{}{}", value < 0 ? "-" : "", with_commas(digits, std::min(digits.find('.'), digits.size())));
}

}  // namespace

std::string grouped(std::uint64_t value) {
  const std::string digits = std::to_string(value);
  return with_commas(digits, digits.size());
}

std::string significant(double value, int digits) {
  if (value != 0 && std::fabs(value) < 1e-6) return fmt::format("{:.{}e}", value, digits - 1);
  return fixed(value, decimals_for(value, digits));
}

std::string with_interval(const Estimate& estimate, int digits) {
  const int decimals = decimals_for(estimate.median, digits);
  return fmt::format("{} ({}–{})", fixed(estimate.median, decimals), fixed(estimate.low, decimals),
                     fixed(estimate.high, decimals));
}

std::string bytes_text(std::uint64_t bytes) {
  constexpr std::array units = {"kB", "MB", "GB", "TB"};
  if (bytes < 1000) return fmt::format("{} B", bytes);
  double value = static_cast<double>(bytes) / 1000;
  std::size_t unit = 0;
  for (; value >= 999.5 && unit + 1 < units.size(); ++unit) value /= 1000;
  return fmt::format("{} {}", significant(value), units[unit]);
}

std::string duration_text(double seconds) {
  if (seconds < 1) return fmt::format("{} ms", significant(seconds * 1000));
  if (seconds < 99.5) return fmt::format("{} s", significant(seconds));
  const auto whole = static_cast<std::uint64_t>(std::llround(seconds));
  return fmt::format("{} min {:02} s", whole / 60, whole % 60);
}

std::string counted(std::uint64_t count, const std::string& noun) {
  return fmt::format("{} {}{}", grouped(count), noun, count == 1 ? "" : "s");
}

}  // namespace boxwood
