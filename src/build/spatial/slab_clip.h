#pragma once
#include <array>
#include <cstdint>

#include "build/build_input.h"
#include "build/float4.h"
#include "build/spatial/split.h"

namespace boxwood {

/// Boxes of the parts of a reference in consecutive slabs. Good enough to price splits; what is split for good is
/// clipped by Geometry::clip(), which rounds outward.
class SlabClip {
 public:
  SlabClip(const Slabs& slabs, const Geometry& geometry) : slabs_(slabs), geometry_(geometry) {}

  /// Calls part(slab, box) for the slabs [first, last] of an axis. `reference` is the box of the part of the primitive
  /// that is asked about.
  template <class Part>
  void each_slab(std::uint32_t primitive, const Box4& reference, int axis, std::int32_t first, std::int32_t last,
                 Part&& part) {
    box_ = reference;
    load_corners(primitive);
    if (is_triangle_) {
      for (std::int32_t s = first; s <= last; ++s) parts_[static_cast<std::size_t>(s)] = {};
      for (std::size_t c = 0; c < 3; ++c) add_edge(corners_[c], corners_[(c + 1) % 3], axis, first, last);
    }
    for (std::int32_t s = first; s <= last; ++s) {
      Box4 slab = box_;
      if (s > first) slab.lower[axis] = slabs_.border(s, axis);
      if (s < last) slab.upper[axis] = slabs_.border(s + 1, axis);
      if (is_triangle_) {
        slab.lower = max4(slab.lower, parts_[static_cast<std::size_t>(s)].lower);
        slab.upper = min4(slab.upper, parts_[static_cast<std::size_t>(s)].upper);
      }
      if (slab.lower[0] <= slab.upper[0] && slab.lower[1] <= slab.upper[1] && slab.lower[2] <= slab.upper[2]) {
        part(s, slab);
      }
    }
  }

 private:
  void load_corners(std::uint32_t primitive);
  void add_edge(Float4 from, Float4 to, int axis, std::int32_t first, std::int32_t last);

  const Slabs& slabs_;
  const Geometry& geometry_;
  Box4 box_;
  bool is_triangle_ = false;
  std::array<Float4, 3> corners_{};
  std::array<Box4, max_spatial_bins> parts_;
};

}  // namespace boxwood
