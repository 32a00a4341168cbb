#include "scene/importers/pbrt/tokens.h"

#include <fmt/format.h>

#include "boxwood/error.h"
#include "scene/importers/text_file.h"

namespace boxwood::pbrt {
namespace {

constexpr std::size_t longest_word = 1'000, longest_text = 65'536;

bool is_blank(int c) { return c == ' ' || c == '\t' || c == '\r' || c == '\n' || c == '\v' || c == '\f'; }
bool ends_word(int c) { return c == ByteStream::end || is_blank(c) || c == '"' || c == '[' || c == ']' || c == '#'; }

}  // namespace

std::string Tokens::place() const { return fmt::format("{}:{}", bytes_.name(), token_line_); }

void Tokens::fail(std::string_view what) const { throw Error(fmt::format("{}: {}", place(), what)); }

void Tokens::fail_expected(std::string_view what, const Token& found) const {
  const std::string shown = found.kind == Token::Kind::end     ? "the end of the file"
                            : found.kind == Token::Kind::open  ? "'['"
                            : found.kind == Token::Kind::close ? "']'"
                                                               : fmt::format("'{}'", found.text.substr(0, 40));
  fail(fmt::format("expected {}, found {}; mend the line", what, shown));
}

int Tokens::skip_blanks() {
  for (bool comment = false;; bytes_.take()) {
    const int c = bytes_.peek();
    if (c == ByteStream::end) return c;
    if (c == '\n') {
      ++line_;
      comment = false;
    } else if (c == '#') {
      comment = true;
    } else if (!comment && !is_blank(c)) {
      return c;
    }
  }
}

void Tokens::read_quoted() {
  bytes_.take();
  for (;; bytes_.take()) {
    int c = bytes_.peek();
    if (c == '"') return bytes_.take();
    if (c == '\\') {
      bytes_.take();
      c = bytes_.peek();
    }
    if (c == ByteStream::end || c == '\n') fail("a text in quotes does not end on its line; add the closing quote");
    if (buffer_.size() == longest_text) {
      fail(fmt::format("a text is longer than {} bytes; the file is damaged", longest_text));
    }
    buffer_.push_back(static_cast<char>(c));
  }
}

void Tokens::read() {
  buffer_.clear();
  const int first = skip_blanks();
  token_line_ = line_;
  if (first == ByteStream::end) {
    token_.kind = Token::Kind::end;
  } else if (first == '[' || first == ']') {
    bytes_.take();
    token_.kind = first == '[' ? Token::Kind::open : Token::Kind::close;
  } else if (first == '"') {
    read_quoted();
    token_.kind = Token::Kind::text;
  } else {
    for (int c = first; !ends_word(c); bytes_.take(), c = bytes_.peek()) {
      if (buffer_.size() == longest_word) {
        fail(fmt::format("a word is longer than {} bytes; this is no scene file, or it is damaged", longest_word));
      }
      buffer_.push_back(static_cast<char>(c));
    }
    token_.kind = Token::Kind::word;
  }
  token_.text = buffer_;
}

const Token& Tokens::peek() {
  if (!ahead_) read();
  ahead_ = true;
  return token_;
}

Token Tokens::next() {
  if (!ahead_) read();
  ahead_ = false;
  return token_;
}

float Tokens::number(std::string_view what) {
  const Token token = next();
  double value = 0;
  if (token.kind != Token::Kind::word || !parse_number(token.text, value)) {
    fail_expected(fmt::format("a number for {}", what), token);
  }
  return static_cast<float>(value);
}

std::string Tokens::text(std::string_view what) {
  const Token token = next();
  if (token.kind != Token::Kind::text) fail_expected(fmt::format("{} in quotes", what), token);
  return std::string(token.text);
}

void Tokens::close(std::string_view what) {
  const Token token = next();
  if (token.kind != Token::Kind::close) fail_expected(fmt::format("']' after the numbers of {}", what), token);
}

}  // namespace boxwood::pbrt
