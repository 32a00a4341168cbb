#pragma once
#include <cstddef>
#include <span>

#include "distance/placed_triangle.h"

namespace boxwood {

/// An axis-parallel ray from a point.
struct AxisRay {
  Vec3 origin;
  std::size_t axis = 2;
  bool descending = false;  ///< along -axis

  /// Whether it can meet what is in the box.
  bool meets(const Box& box) const;
};

/// How the ray crosses the triangle: +1 or -1 by the side that it comes from, 0 where it does not. Over the triangles
/// of a closed surface the sum is the number of times that it winds around the ray's origin, up to its sign.
int crossing(const PlacedTriangle& triangle, const AxisRay& ray);

/// Edges that do not run as often one way as the other, by the places of their ends. 0: closed. O(n log n).
std::size_t open_edges(std::span<const PlacedTriangle> triangles);

}  // namespace boxwood
