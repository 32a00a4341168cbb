#pragma once
#include <string>

#include "report/cell_grid.h"
#include "study/study_result.h"

namespace boxwood::html {

/// One panel of a plot of two figures against each other, as SVG: a point per cell, with both intervals; the points of
/// the front are ringed, named and joined. `series` are all of the plot, in the order of their hues. The plot's x must
/// be a figure.
std::string scatter_panel(const PlotResult& plot, const std::vector<Levels>& series, const Levels& panel);

}  // namespace boxwood::html
