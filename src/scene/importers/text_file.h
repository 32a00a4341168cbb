#pragma once
#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>

namespace boxwood {

/// The bytes of a file. Throws Error naming the file when it cannot be read.
std::string read_whole_file(const std::filesystem::path& file);

/// Walks through text word by word and knows the line it is in. Words are separated by blanks; a backslash before a
/// line's end joins lines. Refers to the text.
class TextCursor {
 public:
  TextCursor(std::string_view text, std::string file) : text_(text), file_(std::move(file)) {}

  bool at_end() const { return position_ >= text_.size(); }
  std::size_t position() const { return position_; }
  std::size_t line() const { return line_; }
  /// Next word of this line; empty at its end.
  std::string_view word();
  /// What is left of this line, trimmed.
  std::string_view rest_of_line();
  void next_line();
  /// Next word on this line or a later one; empty at the end of the text.
  std::string_view word_across_lines();

  /// Next number on this line. Throws Error that says what was expected.
  float number(std::string_view what);
  /// "file:line: what"
  [[noreturn]] void fail(std::string_view what) const;
  std::string place() const;

 private:
  std::size_t join_length() const;
  void skip_blanks();
  std::string_view text_;
  std::string file_;
  std::size_t position_ = 0, line_ = 1;
};

/// A whole word as a number: decimal, nan or inf; too large ones become infinite, too small ones zero. False when it is
/// something else.
bool parse_number(std::string_view word, double& value);

}  // namespace boxwood
