#include "report/html/plot_data.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace boxwood::html {

std::optional<double> number(const std::string& text) {
  char* end = nullptr;
  const double value = std::strtod(text.c_str(), &end);
  if (text.empty() || *end != '\0' || !std::isfinite(value)) return std::nullopt;
  return value;
}

PlotData::PlotData(const PlotResult& result)
    : spec(result.spec),
      cells(result.cells),
      ratio(!result.spec.figure.baseline.empty()),
      panels(distinct(cells, spec.panels)),
      series(distinct(cells, spec.series)),
      xs(levels_of(cells, spec.x)) {
  numbers = std::ranges::all_of(xs, [](const std::string& x) { return number(x).has_value(); });
  if (numbers) std::ranges::stable_sort(xs, {}, [](const std::string& x) { return *number(x); });
}

std::size_t PlotData::series_of(const Cell& cell) const {
  return static_cast<std::size_t>(std::ranges::find(series, levels(cell, spec.series)) - series.begin());
}

std::size_t PlotData::x_of(const Cell& cell) const {
  return static_cast<std::size_t>(std::ranges::find(xs, cell.factors.at(spec.x)) - xs.begin());
}

std::vector<const Cell*> PlotData::cells_of(const Levels& panel, const Levels& one_series) const {
  std::vector<const Cell*> out;
  for (const Cell& cell : cells) {
    if (levels(cell, spec.panels) == panel && levels(cell, spec.series) == one_series) out.push_back(&cell);
  }
  std::ranges::stable_sort(out, {}, [&](const Cell* cell) { return x_of(*cell); });
  return out;
}

Axis PlotData::y_axis(const Levels& panel) const {
  double low = std::numeric_limits<double>::infinity(), high = -low;
  for (const Cell& cell : cells) {
    if (!ratio && levels(cell, spec.panels) != panel) continue;
    for (const double value : {cell.estimate.low, cell.estimate.median, cell.estimate.high}) {
      if (!std::isfinite(value) || (spec.log_y && !(value > 0))) continue;
      low = std::min(low, value);
      high = std::max(high, value);
    }
  }
  if (low > high) low = high = 1;
  if (ratio) {
    low = std::min(low, 1.0);
    high = std::max(high, 1.0);
  } else if (!spec.log_y && low > 0) {
    low = 0;
  }
  return axis_over(low, high, spec.log_y);
}

}  // namespace boxwood::html
