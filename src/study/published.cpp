#include "study/published.h"

#include <fmt/format.h>

#include <sstream>
#include <string_view>

namespace boxwood {
namespace {

std::string_view trimmed(std::string_view text) {
  const std::size_t begin = text.find_first_not_of(" \t\r");
  return begin == text.npos ? std::string_view() : text.substr(begin, text.find_last_not_of(" \t\r") + 1 - begin);
}

}  // namespace

std::vector<std::vector<std::string>> read_published(const TomlValue& value) {
  std::vector<std::vector<std::string>> rows;
  std::istringstream lines(value.text());
  for (std::string line; std::getline(lines, line);) {
    if (trimmed(line).empty()) continue;
    std::vector<std::string>& row = rows.emplace_back();
    for (std::string_view rest = line;;) {
      const std::size_t bar = rest.find('|');
      row.emplace_back(trimmed(rest.substr(0, bar)));
      if (bar == rest.npos) break;
      rest.remove_prefix(bar + 1);
    }
    if (row.size() != rows.front().size()) {
      value.fail(fmt::format("has {} cells in '{}' and {} in its first line", row.size(), line, rows.front().size()));
    }
  }
  return rows;
}

}  // namespace boxwood
