#pragma once
#include <array>
#include <cstdint>
#include <functional>

#include "boxwood/vec3.h"
#include "tree/statistics.h"
#include "tree/tree.h"

namespace boxwood {

/// Corners of a primitive. Thread safe.
using CornersOf = std::function<std::array<Vec3, 3>(std::uint32_t primitive)>;

/// Surface that rays may end on and that lies in nodes which do not hold it. Aila, Karras, Laine 2013, "On Quality
/// Metrics of Bounding Volume Hierarchies".
struct EndPointOverlap {
  /// Sum over nodes N of C(N) times the area of foreign triangles in N's box, over the area of all triangles; C is the
  /// traversal constant for inner nodes, count times the intersection constant for leaves.
  double epo = 0;
  /// Of `epo`, when triangles were sampled; 0 when it is exact.
  double standard_error = 0;
  /// As the SAH alternatives study words it: area of foreign triangles in inner nodes, in squared units, not weighed.
  double inner_area = 0;
};

/// Over all triangles (`samples` 0), or over that many picked in proportion to their area, evenly spread over the
/// references. A triangle in a box's face is in the box. Triangles of no area count for nothing. In double, in
/// parallel; the same for any number of threads. O(triangles * nodes they meet).
EndPointOverlap end_point_overlap(const Tree& tree, const CornersOf& corners, std::uint32_t samples = 0,
                                  const SahConstants& constants = {});

}  // namespace boxwood
