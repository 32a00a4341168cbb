#pragma once
#include <cstdint>
#include <vector>

#include "boxwood/ray.h"
#include "boxwood/scene.h"

namespace boxwood {

enum class Judgement : std::uint8_t {
  agrees,       ///< the hit, or the miss, is the one exact arithmetic finds
  edge_or_tie,  ///< within rounding of an edge, of another triangle at the same distance, or of the ray's limits
  wrong         ///< no rounding explains it
};

/// Judges hits in double precision by an independent test (Möller, Trumbore 1997) over every usable triangle in world
/// space. Its tolerance is a distance, 2^-18 of the magnitudes that a float test of this ray handles.
class Judge {
 public:
  /// Copies what it needs. O(placed triangles) of memory and time.
  explicit Judge(const Scene& scene);

  /// What to think of `claimed` as the closest hit of `ray`. O(placed triangles). Thread safe.
  Judgement closest_hit(const Ray& ray, const Hit& claimed) const;

 private:
  struct WorldTriangle {
    double vertices[3][3];
    std::uint32_t primitive, instance;
    float magnitude;  ///< what rounding is relative to, beside the ray's origin
    float gain;       ///< how much an instance's transform multiplies it
  };
  std::vector<WorldTriangle> triangles_;
};

}  // namespace boxwood
