#pragma once
#include <algorithm>

#include "build/cut_by_count.h"

namespace boxwood {

/// Where planes cut a set of references: between low and high on an axis, k parts of equal width.
struct PlaneRange {
  int axis = 0;
  float low = 0, high = 0;
  bool inclusive = false;  ///< a point on a plane goes to the part below it
};

/// Cuts at planes of equal distance; by count where all points fall between the same two. O(n k).
template <class Points>
Cuts cut_at_planes(const ReferenceSet& set, const Points& points, const PlaneRange& range, std::uint32_t k) {
  Cuts cuts;
  cuts.axis = static_cast<std::uint32_t>(range.axis);
  auto begin = set.references.begin();
  for (std::uint32_t i = 1; i < k; ++i) {
    const float share = static_cast<float>(i) / static_cast<float>(k);
    const float plane = range.low * (1 - share) + range.high * share;
    begin = std::partition(begin, set.references.end(), [&](const Reference& reference) {
      const float at = points(reference)[range.axis];
      return range.inclusive ? at <= plane : at < plane;
    });
    cuts.add(static_cast<std::uint32_t>(begin - set.references.begin()), set.size());
  }
  return cuts.count ? cuts : cut_by_count(set, points, range.axis, k);
}

}  // namespace boxwood
