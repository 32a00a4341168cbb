#include "study/toml.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>

#include "options/suggest.h"

namespace boxwood {

void TomlValue::fail(std::string_view what) const {
  const std::string where = line == 0 ? *file : fmt::format("{}:{}", *file, line);
  throw UsageError(fmt::format("{}: {} {}", where, path.empty() ? "the file" : "'" + path + "'", what));
}

bool TomlValue::boolean() const {
  if (const bool* value = std::get_if<bool>(&data)) return *value;
  fail("takes true or false");
}

double TomlValue::number() const {
  if (const double* value = std::get_if<double>(&data)) return *value;
  if (const std::int64_t* value = std::get_if<std::int64_t>(&data)) return static_cast<double>(*value);
  fail("takes a number");
}

double TomlValue::number(double low, double high) const {
  const double value = number();
  if (!(value >= low && value <= high)) fail(fmt::format("takes a number from {} to {}, not {}", low, high, value));
  return value;
}

std::uint32_t TomlValue::integer(std::uint32_t low, std::uint32_t high) const {
  const std::int64_t* value = std::get_if<std::int64_t>(&data);
  if (!value || *value < low || *value > high) fail(fmt::format("takes a whole number from {} to {}", low, high));
  return static_cast<std::uint32_t>(*value);
}

const std::string& TomlValue::text() const {
  if (const std::string* value = std::get_if<std::string>(&data)) return *value;
  fail("takes a text in quotes");
}

const TomlValue::List& TomlValue::list() const {
  if (const List* value = std::get_if<List>(&data)) return *value;
  fail("takes a list in [brackets]");
}

const TomlValue::Table& TomlValue::table() const {
  if (const Table* value = std::get_if<Table>(&data)) return *value;
  fail("takes a table of names and values");
}

std::string TomlValue::word() const {
  if (const std::string* value = std::get_if<std::string>(&data)) return *value;
  if (const bool* value = std::get_if<bool>(&data)) return *value ? "on" : "off";
  if (const std::int64_t* value = std::get_if<std::int64_t>(&data)) return std::to_string(*value);
  if (const double* value = std::get_if<double>(&data)) return fmt::format("{}", *value);
  fail("takes a text, a number, true or false");
}

std::vector<std::string> TomlValue::words() const {
  if (!is_list()) return {word()};
  std::vector<std::string> out;
  for (const TomlValue& item : list()) out.push_back(item.word());
  return out;
}

const TomlValue* TomlReader::find(std::string_view key) {
  known_.emplace_back(key);
  const auto found = std::ranges::find(table_, key, &TomlEntry::first);
  return found == table_.end() ? nullptr : &found->second;
}

const TomlValue& TomlReader::need(std::string_view key) {
  if (const TomlValue* value = find(key)) return *value;
  value_.fail(fmt::format("needs '{}'", key));
}

std::string TomlReader::text(std::string_view key, std::string_view otherwise) {
  const TomlValue* value = find(key);
  return value ? value->text() : std::string(otherwise);
}

std::vector<std::string> TomlReader::words(std::string_view key, std::vector<std::string> otherwise) {
  const TomlValue* value = find(key);
  return value ? value->words() : std::move(otherwise);
}

std::uint32_t TomlReader::integer(std::string_view key, std::uint32_t low, std::uint32_t high,
                                  std::uint32_t otherwise) {
  const TomlValue* value = find(key);
  return value ? value->integer(low, high) : otherwise;
}

double TomlReader::number(std::string_view key, double low, double high, double otherwise) {
  const TomlValue* value = find(key);
  return value ? value->number(low, high) : otherwise;
}

bool TomlReader::boolean(std::string_view key, bool otherwise) {
  const TomlValue* value = find(key);
  return value ? value->boolean() : otherwise;
}

std::vector<const TomlValue*> TomlReader::tables(std::string_view key) {
  std::vector<const TomlValue*> out;
  const TomlValue* value = find(key);
  if (!value) return out;
  if (!value->is_list()) value->fail(fmt::format("is written [[{}]], one for each", key));
  for (const TomlValue& item : value->list()) {
    if (!item.is_table()) item.fail(fmt::format("is written [[{}]], one for each", key));
    out.push_back(&item);
  }
  return out;
}

void TomlReader::done() const {
  for (const auto& [key, value] : table_) {
    if (std::ranges::find(known_, key) != known_.end()) continue;
    value.fail(fmt::format("means nothing here; {}", suggest(key, known_)));
  }
}

}  // namespace boxwood
