#include "report/table.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstdint>

namespace boxwood {
namespace {

struct Range {
  std::uint32_t first, last;
};

template <std::size_t N>
bool lies_in(std::uint32_t code, const std::array<Range, N>& ranges) {
  return std::any_of(ranges.begin(), ranges.end(),
                     [&](const Range& range) { return range.first <= code && code <= range.last; });
}

// The large blocks of Unicode 15's EastAsianWidth (W, F) and of its combining marks; enough for names of scenes.
constexpr std::array<Range, 10> wide = {{{0x1100, 0x115f},
                                         {0x2e80, 0x303e},
                                         {0x3041, 0xa4cf},
                                         {0xac00, 0xd7a3},
                                         {0xf900, 0xfaff},
                                         {0xfe30, 0xfe6f},
                                         {0xff00, 0xff60},
                                         {0xffe0, 0xffe6},
                                         {0x1f300, 0x1faff},
                                         {0x20000, 0x3fffd}}};
constexpr std::array<Range, 4> combining = {{{0x0300, 0x036f}, {0x1ab0, 0x1aff}, {0x200b, 0x200f}, {0x20d0, 0x20ff}}};

bool continues(char byte) { return (static_cast<unsigned char>(byte) & 0xc0) == 0x80; }

/// The character at `at`, which moves behind it. A byte that begins none counts as a character of its own.
std::uint32_t next_character(std::string_view utf8, std::size_t& at) {
  const auto head = static_cast<unsigned char>(utf8[at++]);
  std::uint32_t code = head < 0xc0 ? head : head < 0xe0 ? head & 0x1fu : head < 0xf0 ? head & 0x0fu : head & 0x07u;
  if (head < 0xc0) return code;
  while (at < utf8.size() && continues(utf8[at])) code = code << 6 | (static_cast<unsigned char>(utf8[at++]) & 0x3fu);
  return code;
}

std::string pad(const std::string& text, std::size_t width, Align align) {
  const std::string spaces(width - std::min(width, display_width(text)), ' ');
  return align == Align::left ? text + spaces : spaces + text;
}

std::string line(const std::vector<std::string>& cells) {
  std::string out;
  for (std::size_t i = 0; i < cells.size(); ++i) {
    if (i > 0) out += "  ";
    out += cells[i];
  }
  out.erase(out.find_last_not_of(' ') + 1);
  return out + "\n";
}

std::string escape_bars(const std::string& text) {
  std::string out;
  for (const char c : text) {
    if (c == '|') out += '\\';
    out += c;
  }
  return out;
}

}  // namespace

std::size_t display_width(std::string_view utf8) {
  std::size_t width = 0;
  for (std::size_t at = 0; at < utf8.size();) {
    const std::uint32_t code = next_character(utf8, at);
    width += lies_in(code, combining) ? 0 : lies_in(code, wide) ? 2 : 1;
  }
  return width;
}

std::string Table::text() const {
  std::vector<std::size_t> widths;
  for (std::size_t c = 0; c < columns_.size(); ++c) {
    widths.push_back(display_width(columns_[c].head));
    for (const auto& row : rows_) {
      if (c < row.size()) widths[c] = std::max(widths[c], display_width(row[c]));
    }
  }
  std::vector<std::string> heads, rules;
  for (std::size_t c = 0; c < columns_.size(); ++c) {
    heads.push_back(pad(columns_[c].head, widths[c], columns_[c].align));
    std::string rule;
    for (std::size_t i = 0; i < widths[c]; ++i) rule += "─";
    rules.push_back(rule);
  }
  std::string out = line(heads) + line(rules);
  for (const auto& row : rows_) {
    std::vector<std::string> cells;
    for (std::size_t c = 0; c < row.size(); ++c) cells.push_back(pad(row[c], widths[c], columns_[c].align));
    out += line(cells);
  }
  return out;
}

std::string Table::markdown() const {
  std::string heads = "|", rules = "|";
  for (const Column& column : columns_) {
    heads += fmt::format(" {} |", column.head);
    rules += column.align == Align::left ? "---|" : "---:|";
  }
  std::string out = fmt::format("{}\n{}\n", heads, rules);
  for (const auto& row : rows_) {
    out += "|";
    for (const std::string& cell : row) out += fmt::format(" {} |", escape_bars(cell));
    out += "\n";
  }
  return out;
}

}  // namespace boxwood
