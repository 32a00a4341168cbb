#include "report/cell_grid.h"

#include <fmt/format.h>

#include <cmath>
#include <set>

#include "report/number_text.h"

namespace boxwood {

Levels levels(const Cell& cell, const std::vector<std::string>& factors) {
  Levels out;
  for (const std::string& factor : factors) out.push_back(cell.factors.at(factor));
  return out;
}

std::vector<Levels> distinct(const std::vector<Cell>& cells, const std::vector<std::string>& factors) {
  std::vector<Levels> out;
  std::set<Levels> known;
  for (const Cell& cell : cells) {
    Levels one = levels(cell, factors);
    if (known.insert(one).second) out.push_back(std::move(one));
  }
  return out;
}

CellGrid::CellGrid(const std::vector<Cell>& cells, const std::vector<std::string>& row_factors,
                   const std::vector<std::string>& column_factors)
    : rows_(distinct(cells, row_factors)), columns_(distinct(cells, column_factors)) {
  for (const Cell& cell : cells)
    cells_.emplace(std::pair(levels(cell, row_factors), levels(cell, column_factors)), &cell);
}

const Cell* CellGrid::find(const Levels& row, const Levels& column) const {
  const auto found = cells_.find({row, column});
  return found == cells_.end() ? nullptr : found->second;
}

std::string cell_text(const Cell& cell) {
  if (!cell.exact) return with_interval(cell.estimate);
  const double value = cell.estimate.median;
  const bool small_count = value == std::floor(value) && std::abs(value) < 1000;
  return small_count ? fmt::format("{:.0f}", value) : significant(value);
}

}  // namespace boxwood
