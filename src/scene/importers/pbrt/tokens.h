#pragma once
#include <array>
#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>

#include "scene/importers/gzip_file.h"

namespace boxwood::pbrt {

struct Token {
  enum class Kind { end, word, text, open, close };  ///< word: directives and numbers; text: quoted; brackets
  Kind kind = Kind::end;
  std::string_view text;  ///< valid until the next token is read
};

/// Cuts one scene file into tokens, as a stream; comments fall away. Throws Error with file and line on a text that is
/// not closed on its line, or on a word or text that is absurdly long.
class Tokens {
 public:
  explicit Tokens(const std::filesystem::path& file) : bytes_(file) {}

  /// The next token, which stays the next.
  const Token& peek();
  Token next();

  /// A number; for 'what', say what it is for.
  float number(std::string_view what);
  std::string text(std::string_view what);
  /// Numbers that may stand in brackets.
  template <std::size_t n>
  std::array<float, n> numbers(std::string_view what) {
    std::array<float, n> values;
    const bool bracket = peek().kind == Token::Kind::open;
    if (bracket) next();
    for (float& value : values) value = number(what);
    if (bracket) close(what);
    return values;
  }
  void close(std::string_view what);

  /// "FILE:LINE" of the token that was read last.
  std::string place() const;
  [[noreturn]] void fail(std::string_view what) const;
  /// The last token, for an error.
  [[noreturn]] void fail_expected(std::string_view what, const Token& found) const;

 private:
  void read();
  void read_quoted();
  int skip_blanks();
  ByteStream bytes_;
  std::string buffer_;
  Token token_;
  bool ahead_ = false;
  std::size_t line_ = 1, token_line_ = 1;
};

}  // namespace boxwood::pbrt
