#pragma once
#include <optional>
#include <string>
#include <vector>

#include "measure/statistics.h"
#include "study/observations.h"

namespace boxwood {

/// Figures that belong together, told apart from others by the levels of some factors.
struct Cell {
  Factors factors;               ///< of the factors that tell cells apart
  std::size_t members = 0;       ///< series in it
  double triangles = 0;          ///< of its scene; the largest where there are several
  std::vector<double> values;    ///< a sample per repetition: the mean of the members
  std::vector<double> baseline;  ///< likewise, of their baselines; empty when the figure is no ratio
  Estimate estimate;             ///< of the values, or of baseline / values: centre and interval
  double mean = 0;               ///< likewise; the estimate's centre may be a median
  bool exact = false;            ///< not measured in time: the same in every run
};

/// The cells of a figure in the order of the study: all series that match `where`, grouped by the levels of `each`.
/// A series whose baseline was not measured is left out; so is one that lacks a factor of `each`. Members of ratios are
/// averaged geometrically, others arithmetically. Throws UsageError when a baseline is not one recipe but several.
std::vector<Cell> cells(const Study& study, const Observations& observations, const FigureSpec& figure,
                        const std::vector<std::string>& each);

/// The cell of `figure` that belongs to each of `of`: the one with the same levels of all factors that series of
/// `figure` have (bytes have no kind of rays). Nothing where none was measured.
std::vector<std::optional<Cell>> cells_beside(const Study& study, const Observations& observations,
                                              const FigureSpec& figure, const std::vector<Cell>& of);

/// a / b, repetition by repetition. A figure that is the same in every run counts for every repetition of the other.
Cell quotient(const Study& study, const Cell& a, const Cell& b);

/// "k 4, method sah"
std::string cell_name(const Factors& factors);

/// In the order of the study: levels of `factor` as they first appear in `cells`.
std::vector<std::string> levels_of(const std::vector<Cell>& cells, const std::string& factor);

}  // namespace boxwood
