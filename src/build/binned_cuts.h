// The cheapest borders between equal bins along the axes of some frame: what every binned builder shares.
#pragma once
#include "build/best_cuts.h"
#include "build/bins.h"
#include "build/cost_options.h"

namespace boxwood {

/// Moves the references that `is_left` holds for to the front and returns their number. Without a branch on the
/// outcome, which nothing could predict.
template <class IsLeft>
std::uint32_t partition(std::span<Reference> references, const IsLeft& is_left) {
  std::size_t left = 0;
  for (Reference& reference : references) {
    const Reference moved = reference;
    reference = references[left];
    references[left] = moved;
    left += is_left(moved) ? 1 : 0;
  }
  return static_cast<std::uint32_t>(left);
}

struct BinnedCuts {
  BinMapping mapping;
  BestCuts best;  ///< at bin numbers; none: every border costs the same, or there is nothing to tell references apart
  int axis = 0;
};

/// Searches the axes' bin borders for the cheapest. `range` is the box around the points. O(n + bins).
template <class Points, class Pricing>
BinnedCuts find_binned_cuts(const ReferenceSet& set, const Points& points, const Box4& range, AxisRange axes,
                            std::uint32_t bin_count, std::uint32_t k, const Pricing& pricing) {
  BinnedCuts cuts{BinMapping(range, bin_count), {}};
  // Bin along all axes in one pass.
  Bins bins(axes.first, axes.last, bin_count);
  fill(bins, set, points, cuts.mapping);
  for (int axis = axes.first; axis <= axes.last; ++axis) {
    const BestCuts found = best_cuts(bins.row(axis), pricing, bin_count, k);
    if (!(found.price < cuts.best.price)) continue;
    cuts.best = found;
    cuts.axis = axis;
  }
  return cuts;
}

/// Moves the references into their parts.
template <class Points>
Cuts apply(const BinnedCuts& found, const ReferenceSet& set, const Points& points) {
  Cuts cuts;
  cuts.axis = static_cast<std::uint32_t>(found.axis);
  std::uint32_t begin = 0;
  for (std::uint32_t i = 0; i < found.best.count; ++i) {
    const auto border = static_cast<std::int32_t>(found.best.at[i]);
    begin += partition(set.references.subspan(begin), [&](const Reference& reference) {
      return found.mapping(points(reference), found.axis) < border;
    });
    cuts.add(begin, set.size());
  }
  return cuts;
}

}  // namespace boxwood
