#pragma once
#include <array>
#include <span>
#include <vector>

#include "build/bins.h"
#include "build/hit_lists.h"
#include "build/prices.h"

namespace boxwood {

/// The rays that come to a node, with what they would hit in it.
struct NodeRays {
  struct Entry {
    std::uint32_t ray, first, count;  ///< hits [first, first + count)
  };
  std::vector<Entry> entries;
  std::vector<std::uint32_t> hits;  ///< primitives

  std::span<const std::uint32_t> hits_of(const Entry& entry) const {
    return std::span(hits).subspan(entry.first, entry.count);
  }
};

/// A division of a node's references between two bins, and which side rays visit first.
struct ShadowSplit {
  float cost = no_price;
  int axis = 0;
  std::int32_t border = 0;  ///< left: the bins before it
  bool right_first = false;
  Box left, right;
  BinMapping mapping{Box4{}, 1};

  bool found() const { return cost < no_price; }
};

/// Doubled centres by primitive.
using CentersByPrimitive = std::vector<std::array<float, 3>>;

/// The cheapest division and order for the rays, each of which is ended by any hit: a side costs its references for
/// every ray that meets its box, unless the ray was ended on the other side before. Without rays, the cheapest by
/// surface area. SAH alternatives study, section 2.13, equation 19 as mended there. O(references + rays bins).
ShadowSplit find_shadow_split(const ReferenceSet& set, const Centroids& centroids, const CentersByPrimitive& centers2,
                              const SegmentHits& lists, const NodeRays& rays, std::uint32_t bins);

}  // namespace boxwood
