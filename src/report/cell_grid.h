#pragma once
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "study/figure.h"

namespace boxwood {

using Levels = std::vector<std::string>;

/// The cell's levels of some factors, in their order. Throws std::out_of_range for a factor that it lacks.
Levels levels(const Cell& cell, const std::vector<std::string>& factors);

/// The combinations of levels that there are, in the order of the cells.
std::vector<Levels> distinct(const std::vector<Cell>& cells, const std::vector<std::string>& factors);

/// Cells by row and column. Refers to the cells, which must outlive it.
class CellGrid {
 public:
  CellGrid(const std::vector<Cell>& cells, const std::vector<std::string>& row_factors,
           const std::vector<std::string>& column_factors);

  const std::vector<Levels>& rows() const { return rows_; }
  const std::vector<Levels>& columns() const { return columns_; }
  /// nullptr where nothing was measured.
  const Cell* find(const Levels& row, const Levels& column) const;

 private:
  std::vector<Levels> rows_, columns_;
  std::map<std::pair<Levels, Levels>, const Cell*> cells_;
};

/// "12.3 (11.9–12.8)"; exact figures have no interval.
std::string cell_text(const Cell& cell);

}  // namespace boxwood
