#include "scene/importers/pbrt/parameters.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>

#include "boxwood/error.h"
#include "scene/importers/text_file.h"

namespace boxwood::pbrt {
namespace {

bool is_integer_type(std::string_view type) { return type == "integer"; }
bool is_text_type(std::string_view type) { return type == "string" || type == "texture" || type == "bool"; }

std::int32_t to_integer(Tokens& tokens, const Token& token, const Parameter& parameter) {
  std::int32_t value = 0;
  const char *begin = token.text.data(), *end = begin + token.text.size();
  const auto [stop, error] = std::from_chars(begin, end, value);
  if (token.kind != Token::Kind::word || error != std::errc{} || stop != end) {
    tokens.fail_expected(fmt::format("a whole number for '{}'", parameter.name), token);
  }
  return value;
}

void read_value(Tokens& tokens, Parameter& parameter) {
  const Token token = tokens.next();
  if (is_integer_type(parameter.type)) {
    parameter.integers.push_back(to_integer(tokens, token, parameter));
    return;
  }
  const bool may_be_text = is_text_type(parameter.type) || parameter.type == "spectrum";
  if (may_be_text && token.kind == Token::Kind::text) {
    parameter.texts.emplace_back(token.text);
    return;
  }
  if (parameter.type == "bool" && (token.text == "true" || token.text == "false")) {
    parameter.texts.emplace_back(token.text);
    return;
  }
  double value = 0;
  if (is_text_type(parameter.type) || token.kind != Token::Kind::word || !parse_number(token.text, value)) {
    tokens.fail_expected(fmt::format("a value of type {} for '{}'", parameter.type, parameter.name), token);
  }
  parameter.numbers.push_back(static_cast<float>(value));
}

/// "TYPE NAME", with any blanks around.
void split_declaration(Tokens& tokens, std::string_view text, Parameter& parameter) {
  TextCursor cursor(text, {});
  parameter.type = cursor.word();
  parameter.name = cursor.rest_of_line();
  if (parameter.name.empty()) {
    tokens.fail(fmt::format("'{}' must be a type and a name, such as \"float radius\"", text.substr(0, 40)));
  }
}

Parameter read_parameter(Tokens& tokens) {
  Parameter parameter;
  const Token declaration = tokens.next();
  split_declaration(tokens, declaration.text, parameter);
  if (tokens.peek().kind != Token::Kind::open) {
    read_value(tokens, parameter);
    return parameter;
  }
  tokens.next();
  while (tokens.peek().kind != Token::Kind::close) {
    if (tokens.peek().kind == Token::Kind::end) tokens.fail_expected("']'", tokens.peek());
    read_value(tokens, parameter);
  }
  tokens.next();
  return parameter;
}

}  // namespace

Parameters::Parameters(Tokens& tokens) : place_(tokens.place()) {
  while (tokens.peek().kind == Token::Kind::text) list_.push_back(read_parameter(tokens));
  if (tokens.peek().kind == Token::Kind::open || tokens.peek().kind == Token::Kind::close) {
    tokens.fail_expected("a parameter or a directive", tokens.peek());
  }
}

void Parameters::fail(std::string_view what) const { throw Error(fmt::format("{}: {}", place_, what)); }

const Parameter* Parameters::find(std::string_view name) const {
  const auto found = std::ranges::find(list_, name, &Parameter::name);
  return found == list_.end() ? nullptr : &*found;
}

const float& Parameters::first_number(const Parameter& parameter) const {
  if (parameter.numbers.empty()) fail(fmt::format("the parameter '{}' must be a number", parameter.name));
  return parameter.numbers.front();
}

float Parameters::number(std::string_view name, float otherwise) const {
  const Parameter* found = find(name);
  if (!found) return otherwise;
  if (!found->integers.empty()) return static_cast<float>(found->integers.front());
  return first_number(*found);
}

std::int32_t Parameters::integer(std::string_view name, std::int32_t otherwise) const {
  const Parameter* found = find(name);
  if (!found) return otherwise;
  if (found->integers.empty()) fail(fmt::format("the parameter '{}' must be a whole number", name));
  return found->integers.front();
}

std::string Parameters::text(std::string_view name, std::string_view otherwise) const {
  const Parameter* found = find(name);
  if (!found) return std::string(otherwise);
  if (found->texts.empty()) fail(fmt::format("the parameter '{}' must be a text in quotes", name));
  return found->texts.front();
}

bool Parameters::flag(std::string_view name, bool otherwise) const {
  return text(name, otherwise ? "true" : "false") == "true";
}

Vec3 Parameters::point(std::string_view name, const Vec3& otherwise) const {
  const Parameter* found = find(name);
  if (!found) return otherwise;
  if (found->numbers.size() != 3) fail(fmt::format("the parameter '{}' must be three numbers", name));
  return {found->numbers[0], found->numbers[1], found->numbers[2]};
}

std::vector<Vec3> Parameters::points(std::string_view name) const {
  const Parameter* found = find(name);
  if (!found) return {};
  if (found->numbers.size() % 3 != 0) {
    fail(fmt::format("the parameter '{}' has {} numbers, which are no whole points", name, found->numbers.size()));
  }
  std::vector<Vec3> points(found->numbers.size() / 3);
  for (std::size_t i = 0; i < points.size(); ++i) {
    points[i] = {found->numbers[3 * i], found->numbers[3 * i + 1], found->numbers[3 * i + 2]};
  }
  return points;
}

}  // namespace boxwood::pbrt
