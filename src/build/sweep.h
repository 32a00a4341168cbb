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
};

/// Cuts a set at the cheapest gaps; no cuts when a leaf is cheaper or every gap costs the same. O(n log n).
template <class Pricing>
Cuts sweep(const ReferenceSet& set, const Centroids& centroids, const CostOptions& options, Pricing pricing) {
  Cuts cuts;
  if (is_leaf_by_count(set, options) || !pricing.begin(set.bounds)) return cuts;

  // Find the best axis.
  const std::uint32_t size = set.size();
  Scratch<SortKey, small_set> keys(size), best_keys(size);
  SortKey *next = keys.data(), *kept = best_keys.data();
  BestCuts best;
  const AxisRange axes = axes_of(set, options);
  for (int axis = axes.first; axis <= axes.last; ++axis) {
    if (!(set.centers.lower[axis] < set.centers.upper[axis])) continue;
    for (std::uint32_t i = 0; i < size; ++i) next[i] = sort_key(centroids(set.references[i])[axis], i);
    sort_keys(next, size);
    const BestCuts found = best_cuts(SortedReferences{set.references, next}, pricing, size, options.k);
    if (!(found.price < best.price)) continue;
    best = found;
    cuts.axis = static_cast<std::uint32_t>(axis);
    std::swap(next, kept);
  }
  if (best.count == 0 || is_leaf_by_cost(set, options, best.price)) return cuts;

  // Put the references into its order.
  Scratch<Reference, small_set> sorted(size);
  for (std::uint32_t i = 0; i < size; ++i) sorted[i] = set.references[static_cast<std::uint32_t>(kept[i])];
  std::copy(sorted.data(), sorted.data() + size, set.references.begin());
  for (std::uint32_t i = 0; i < best.count; ++i) cuts.add(best.at[i], size);
  return cuts;
}

}  // namespace boxwood
