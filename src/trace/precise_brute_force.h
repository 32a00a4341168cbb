#pragma once
#include <span>
#include <vector>

#include "boxwood/precise.h"
#include "trace/precise_triangle.h"

namespace boxwood {

/// Every usable triangle against every ray in double precision: what structures in double precision must equal bit for
/// bit. O(triangles) per ray; thread safe.
class PreciseBruteForce {
 public:
  /// Copies what it needs. Indices must be in range.
  PreciseBruteForce(std::span<const DoubleVec3> vertices, std::span<const Triangle> triangles);

  PreciseHit closest_hit(const PreciseRay& ray) const;

 private:
  std::vector<PreciseTriangle> triangles_;
};

}  // namespace boxwood
