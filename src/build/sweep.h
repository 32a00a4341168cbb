// Full sweep: every gap between sorted centroids is a candidate. The wide BVH study, section 2.6; SAH alternatives
// study, section 2.2.
#pragma once
#include <tbb/parallel_sort.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <bit>
#include <utility>

#include "build/best_cuts.h"
#include "build/cost_options.h"

namespace boxwood {

/// A centroid's coordinate, mapped so that integers order as the floats do, above its reference's place in the set.
using SortKey = std::uint64_t;

inline SortKey sort_key(float coordinate, std::uint32_t place) {
  const auto bits = std::bit_cast<std::uint32_t>(coordinate);
  const std::uint32_t ordered = bits & 0x80000000u ? ~bits : bits | 0x80000000u;
  return SortKey{ordered} << 32 | place;
}

inline void sort_keys(SortKey* keys, std::size_t size) {
  if (size < (1 << 14)) {
    std::sort(keys, keys + size);
  } else {
    // Isolated, so that waiting does not start another subtree on top of this one's stack.
    tbb::this_task_arena::isolate([&] { tbb::parallel_sort(keys, keys + size); });
  }
}

/// Items of best_cuts(): references in the order of their keys.
struct SortedReferences {
  std::span<const Reference> references;
  const SortKey* keys;
  Box4 box(std::uint32_t i) const { return box4(references[static_cast<std::uint32_t>(keys[i])]); }
  std::uint32_t count(std::uint32_t) const { return 1; }
  std::uint32_t seen(std::uint32_t i) const {
    return references[static_cast<std::uint32_t>(keys[i])].seen != 0 ? 1 : 0;
  }
};

/// The cheapest gaps of all, and their axis.
struct BestAxis {
  BestCuts cuts;
  std::uint32_t axis = 0;
};

/// The cheapest by `pricing`; but where its model has a rival and does not stand up to it, the cheapest by surface
/// area. `search(pricing)` gives a BestAxis, `parts(best)` what it makes of the set.
template <class Pricing, class Search, class PartsOf>
BestAxis search_with_rival(const ReferenceSet& set, const Pricing& pricing, const Search& search,
                           const PartsOf& parts) {
  const BestAxis own = search(pricing);
  if constexpr (Pricing::is_model) {
    SurfaceAreaPricing area;
    if (!pricing.model().has_rival() || own.cuts.count == 0 || !area.begin(set)) return own;
    const BestAxis by_area = search(area);
    if (by_area.cuts.count > 0 && !pricing.model().accepts(parts(own), parts(by_area))) return by_area;
  }
  return own;
}

/// Cuts a set at the cheapest gaps; no cuts when a leaf is cheaper or every gap costs the same. O(n log n).
template <class Pricing>
Cuts sweep(const ReferenceSet& set, const Centroids& centroids, const CostOptions& options, Pricing pricing) {
  Cuts cuts;
  if (is_leaf_by_count(set, options) || !pricing.begin(set)) return cuts;

  // Find the best axis; `kept` holds the order along it.
  const std::uint32_t size = set.size();
  Scratch<SortKey, small_set> keys(size), best_keys(size);
  SortKey *next = keys.data(), *kept = best_keys.data();
  const AxisRange axes = axes_of(set, options);
  const auto sort_along = [&](int axis, SortKey* order) {
    for (std::uint32_t i = 0; i < size; ++i) order[i] = sort_key(centroids(set.references[i])[axis], i);
    sort_keys(order, size);
  };
  const auto search = [&](const auto& by) {
    BestAxis best;
    for (int axis = axes.first; axis <= axes.last; ++axis) {
      if (!(set.centers.lower[axis] < set.centers.upper[axis])) continue;
      sort_along(axis, next);
      const BestCuts found = best_cuts(SortedReferences{set.references, next}, by, size, options.k);
      if (!(found.price < best.cuts.price)) continue;
      best = {found, static_cast<std::uint32_t>(axis)};
      std::swap(next, kept);
    }
    return best;
  };
  const auto parts = [&](const BestAxis& found) {
    sort_along(static_cast<int>(found.axis), kept);
    return parts_of(SortedReferences{set.references, kept}, found.cuts, size);
  };
  const BestAxis best = search_with_rival(set, pricing, search, parts);
  cuts.axis = best.axis;
  if (best.cuts.count == 0) return cuts;
  if constexpr (Pricing::is_model) {
    if (pricing.model().has_rival()) sort_along(static_cast<int>(best.axis), kept);
  }
  const SortedReferences sorted_references{set.references, kept};
  if (is_leaf_by_cost(set, options, price_for_leaf_test(set, options, sorted_references, size, best.cuts))) return cuts;

  // Put the references into its order.
  Scratch<Reference, small_set> sorted(size);
  for (std::uint32_t i = 0; i < size; ++i) sorted[i] = set.references[static_cast<std::uint32_t>(kept[i])];
  std::copy(sorted.data(), sorted.data() + size, set.references.begin());
  for (std::uint32_t i = 0; i < best.cuts.count; ++i) cuts.add(best.cuts.at[i], size);
  return cuts;
}

}  // namespace boxwood
