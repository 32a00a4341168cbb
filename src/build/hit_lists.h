#pragma once
#include <functional>
#include <span>
#include <vector>

#include "build/build_input.h"
#include "math/segment.h"
#include "tree/tree.h"

namespace boxwood {

/// Representative rays with all primitives that each would hit within [t_near, t_far], however many block it.
struct SegmentHits {
  std::vector<Segment> rays;
  std::vector<std::uint32_t> begin;       ///< of ray i: hits[begin[i]] … hits[begin[i + 1] - 1]
  std::vector<std::uint32_t> primitives;  ///< each once per ray, ascending

  std::span<const std::uint32_t> of(std::uint32_t ray) const {
    return std::span(primitives).subspan(begin[ray], begin[ray + 1] - begin[ray]);
  }
};

/// Of the any-hit rays in `use`, or of all when there are none. Hits are found through `tree`, any tree over the
/// primitives, in plain floating point: good enough to decide by. Parallel; O(rays * nodes met).
SegmentHits hit_lists(const Tree& tree, const Geometry& geometry, const KnownUse& use);

}  // namespace boxwood
