#pragma once
#include <vector>

#include "study/figure.h"

namespace boxwood {

/// The factor whose levels say which cell of a spread table is what.
inline constexpr const char* spread_factor = "of its cells";

/// What a spread table shows of the cells that tell `rows` and `over` apart, for each combination of `rows`: the
/// "lowest", the "mean" (of all, as cells() makes it), the "highest", and their number: of a ratio those "above 1",
/// and "all". O(cells).
std::vector<Cell> spread_cells(const Study& study, const Observations& observations, const FigureSpec& figure,
                               const std::vector<std::string>& rows, const std::vector<std::string>& over);

}  // namespace boxwood
