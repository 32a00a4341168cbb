#pragma once
#include <algorithm>

#include "build/top_down.h"

namespace boxwood {

/// Cuts a set of n references into k parts of equal count along `axis` of the points' frame: cut i is floor(n * i / k).
/// Ties between points go by primitive number, so what is in a part depends on nothing else. O(n k).
template <class Points>
Cuts cut_by_count(const ReferenceSet& set, const Points& points, int axis, std::uint32_t k) {
  Cuts cuts;
  cuts.axis = static_cast<std::uint32_t>(axis);
  const std::uint64_t size = set.size();
  for (std::uint64_t i = 1; i < k; ++i) cuts.add(static_cast<std::uint32_t>(size * i / k), set.size());

  const auto before = [&](const Reference& a, const Reference& b) {
    const float x = points(a)[axis], y = points(b)[axis];
    return x != y ? x < y : a.primitive < b.primitive;
  };
  auto begin = set.references.begin();
  for (std::uint32_t i = 0; i < cuts.count; ++i) {
    const auto cut = set.references.begin() + cuts.at[i];
    std::nth_element(begin, cut, set.references.end(), before);
    begin = cut;
  }
  return cuts;
}

}  // namespace boxwood
