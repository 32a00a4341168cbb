#pragma once
#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "boxwood/error.h"

namespace boxwood {

struct TomlEntry;

/// A value of a TOML file that knows where it stands, so that whoever finds it wrong can say so. Tables keep the order
/// of the file.
class TomlValue {
 public:
  using List = std::vector<TomlValue>;
  using Table = std::vector<TomlEntry>;
  std::variant<bool, std::int64_t, double, std::string, List, Table> data;
  std::string path;        ///< as in "claim.each"
  std::uint32_t line = 0;  ///< 1-based; 0 for the whole file
  const std::string* file = nullptr;

  /// Throws UsageError("FILE:LINE: PATH …").
  [[noreturn]] void fail(std::string_view what) const;

  bool is_text() const { return std::holds_alternative<std::string>(data); }
  bool is_list() const { return std::holds_alternative<List>(data); }
  bool is_table() const { return std::holds_alternative<Table>(data); }
  bool boolean() const;
  double number() const;
  double number(double low, double high) const;
  std::uint32_t integer(std::uint32_t low, std::uint32_t high) const;
  const std::string& text() const;
  const List& list() const;
  const Table& table() const;
  /// A text, number or boolean as it would be written in a recipe.
  std::string word() const;
  /// A list of words, or one word.
  std::vector<std::string> words() const;
};

struct TomlEntry {
  std::string first;
  TomlValue second;
};

/// A file's table, and the name that its values point to.
struct TomlFile {
  std::string name;
  TomlValue root;
};

/// Throws UsageError naming file and line when `text` is no TOML.
std::unique_ptr<const TomlFile> parse_toml(std::string_view text, const std::string& file_name);

/// Reads a table key by key and refuses what nobody asked for.
class TomlReader {
 public:
  explicit TomlReader(const TomlValue& table) : value_(table), table_(table.table()) {}

  /// Null when the key is not there.
  const TomlValue* find(std::string_view key);
  /// Throws UsageError when it is not there.
  const TomlValue& need(std::string_view key);
  std::string text(std::string_view key, std::string_view otherwise = {});
  std::vector<std::string> words(std::string_view key, std::vector<std::string> otherwise = {});
  std::uint32_t integer(std::string_view key, std::uint32_t low, std::uint32_t high, std::uint32_t otherwise);
  double number(std::string_view key, double low, double high, double otherwise);
  bool boolean(std::string_view key, bool otherwise);
  /// The tables under [[key]].
  std::vector<const TomlValue*> tables(std::string_view key);
  const TomlValue& value() const { return value_; }
  /// Throws UsageError on the first key that was not looked for, with the nearest that was.
  void done() const;

 private:
  const TomlValue& value_;
  const TomlValue::Table& table_;
  std::vector<std::string> known_;
};

}  // namespace boxwood
