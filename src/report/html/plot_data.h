#pragma once
#include <optional>
#include <string>
#include <vector>

#include "report/cell_grid.h"
#include "report/html/axis.h"
#include "study/study_result.h"

namespace boxwood::html {

/// A plot's cells in the order in which they are drawn. Refers to the result, which must outlive it.
struct PlotData {
  explicit PlotData(const PlotResult& result);

  const PlotSpec& spec;
  const std::vector<Cell>& cells;
  bool ratio;
  std::vector<Levels> panels, series;
  std::vector<std::string> xs;  ///< ascending when all are numbers, else as the study has them
  bool numbers = false;         ///< whether all are

  std::size_t series_of(const Cell& cell) const;
  std::size_t x_of(const Cell& cell) const;
  /// In the order of xs.
  std::vector<const Cell*> cells_of(const Levels& panel, const Levels& one_series) const;
  /// Ratios have one axis for all panels; others, which depend on the scene, one for each.
  Axis y_axis(const Levels& panel) const;
};

/// The whole text as a finite number.
std::optional<double> number(const std::string& text);

}  // namespace boxwood::html
