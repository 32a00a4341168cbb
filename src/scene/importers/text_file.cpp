#include "scene/importers/text_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <fstream>
#include <limits>

#include "boxwood/error.h"
#include "options/call.h"

namespace boxwood {
namespace {

bool is_blank(char c) { return c == ' ' || c == '\t' || c == '\r' || c == '\v' || c == '\f'; }

}  // namespace

std::string read_whole_file(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  std::error_code error;
  const auto size = std::filesystem::file_size(file, error);
  if (!in || error) throw Error(fmt::format("{}: cannot be opened for reading; check its permissions", file.string()));
  std::string bytes(size, '\0');
  in.read(bytes.data(), static_cast<std::streamsize>(size));
  if (in.gcount() != static_cast<std::streamsize>(size)) {
    throw Error(fmt::format("{}: reading stopped after {} of {} bytes; check the disk and try again", file.string(),
                            in.gcount(), size));
  }
  return bytes;
}

/// Bytes of a joined line's end, a backslash before a line feed, at the cursor; 0 when there is none.
std::size_t TextCursor::join_length() const {
  if (text_[position_] != '\\') return 0;
  if (text_.substr(position_, 2) == "\\\n") return 2;
  return text_.substr(position_, 3) == "\\\r\n" ? 3 : 0;
}

void TextCursor::skip_blanks() {
  while (position_ < text_.size()) {
    if (is_blank(text_[position_])) {
      ++position_;
    } else if (const std::size_t join = join_length(); join > 0) {
      position_ += join;
      ++line_;
    } else {
      return;
    }
  }
}

std::string_view TextCursor::word() {
  skip_blanks();
  const std::size_t begin = position_;
  while (position_ < text_.size() && !is_blank(text_[position_]) && text_[position_] != '\n' && join_length() == 0) {
    ++position_;
  }
  return text_.substr(begin, position_ - begin);
}

std::string_view TextCursor::rest_of_line() {
  const std::size_t begin = position_;
  position_ = std::min(text_.find('\n', position_), text_.size());
  return trim(text_.substr(begin, position_ - begin));
}

void TextCursor::next_line() {
  rest_of_line();
  if (position_ < text_.size()) {
    ++position_;
    ++line_;
  }
}

std::string_view TextCursor::word_across_lines() {
  for (;;) {
    const std::string_view found = word();
    if (!found.empty() || at_end()) return found;
    next_line();
  }
}

float TextCursor::number(std::string_view what) {
  const std::string_view text = word();
  double value = 0;
  if (!parse_number(text, value)) {
    fail(fmt::format("expected {}, found {}; mend or remove the line", what,
                     text.empty() ? "the end of the line" : fmt::format("'{}'", text.substr(0, 40))));
  }
  return static_cast<float>(value);
}

std::string TextCursor::place() const { return fmt::format("{}:{}", file_, line_); }

void TextCursor::fail(std::string_view what) const { throw Error(fmt::format("{}: {}", place(), what)); }

bool parse_number(std::string_view word, double& value) {
  if (word.starts_with('+')) word.remove_prefix(1);
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
  if (end != word.data() + word.size() || error == std::errc::invalid_argument) return false;
  if (error == std::errc::result_out_of_range) {
    const auto exponent = word.find_first_of("eE");
    const auto first_digit = word.find_first_not_of('-');
    const bool tiny = exponent != word.npos ? word.substr(exponent + 1).starts_with('-')
                                            : word[first_digit] == '0' || word[first_digit] == '.';
    value = tiny ? 0 : std::numeric_limits<double>::infinity() * (word.front() == '-' ? -1 : 1);
  }
  // What a float cannot hold is infinite, as if it had been read as one.
  constexpr double largest = std::numeric_limits<float>::max();
  if (value > largest) value = std::numeric_limits<double>::infinity();
  if (value < -largest) value = -std::numeric_limits<double>::infinity();
  return true;
}

}  // namespace boxwood
