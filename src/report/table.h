#pragma once
#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace boxwood {

/// Columns a text takes on a terminal: characters, not bytes; two for East Asian wide ones, none for combining marks.
std::size_t display_width(std::string_view utf8);

enum class Align { left, right };

/// A text table: column heads, a rule, and rows; columns as wide as their widest cell, two spaces apart.
class Table {
 public:
  struct Column {
    std::string head;
    Align align = Align::right;
  };

  explicit Table(std::vector<Column> columns) : columns_(std::move(columns)) {}
  /// One cell per column; missing cells at the end stay empty.
  void add(std::vector<std::string> cells) { rows_.push_back(std::move(cells)); }
  bool empty() const { return rows_.empty(); }

  /// Lines end in '\n' and never in spaces.
  std::string text() const;
  /// As a GitHub table.
  std::string markdown() const;

 private:
  std::vector<Column> columns_;
  std::vector<std::vector<std::string>> rows_;
};

}  // namespace boxwood
