// The cheapest borders between equal bins along the axes of some frame: what every binned builder shares.
#pragma once
#include "build/bins.h"
#include "build/sweep.h"

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
  BestAxis best;         ///< at bin numbers; no cuts: every border costs the same, or nothing tells references apart
  float leaf_price = 0;  ///< what the leaf test is to hold against a leaf
};

/// Searches the axes' bin borders for the cheapest. `range` is the box around the points. O(n + bins).
template <class Points, class Pricing>
BinnedCuts find_binned_cuts(const ReferenceSet& set, const Points& points, const Box4& range, AxisRange axes,
                            std::uint32_t bin_count, const CostOptions& options, const Pricing& pricing) {
  BinnedCuts cuts{BinMapping(range, bin_count), {}};
  // Bin along all axes in one pass.
  Bins bins(axes.first, axes.last, bin_count);
  fill(bins, set, points, cuts.mapping);
  if constexpr (Pricing::is_model) bins.count_seen(set.references, points, cuts.mapping);

  // Find the best axis.
  const auto search = [&](const auto& by) {
    BestAxis best;
    for (int axis = axes.first; axis <= axes.last; ++axis) {
      const BestCuts found = best_cuts(bins.row(axis), by, bin_count, options.k);
      if (found.price < best.cuts.price) best = {found, static_cast<std::uint32_t>(axis)};
    }
    return best;
  };
  const auto row = [&](const BestAxis& found) { return bins.row(static_cast<int>(found.axis)); };
  const auto parts = [&](const BestAxis& found) { return parts_of(row(found), found.cuts, bin_count); };
  cuts.best = search_with_rival(set, pricing, search, parts);
  if (cuts.best.cuts.count > 0) {
    cuts.leaf_price = price_for_leaf_test(set, options, row(cuts.best), bin_count, cuts.best.cuts);
  }
  return cuts;
}

/// Moves the references into their parts.
template <class Points>
Cuts apply(const BinnedCuts& found, const ReferenceSet& set, const Points& points) {
  Cuts cuts;
  cuts.axis = found.best.axis;
  const auto axis = static_cast<int>(found.best.axis);
  std::uint32_t begin = 0;
  for (std::uint32_t i = 0; i < found.best.cuts.count; ++i) {
    const auto border = static_cast<std::int32_t>(found.best.cuts.at[i]);
    begin += partition(set.references.subspan(begin),
                       [&](const Reference& reference) { return found.mapping(points(reference), axis) < border; });
    cuts.add(begin, set.size());
  }
  return cuts;
}

}  // namespace boxwood
