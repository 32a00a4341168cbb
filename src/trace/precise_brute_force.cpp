#include "trace/scalar_targets.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "trace/precise_brute_force.cpp"
#include <hwy/foreach_target.h>
//
#include "trace/precise_brute_force.h"
#include "trace/precise_ray-inl.h"

HWY_BEFORE_NAMESPACE();
namespace boxwood {
namespace HWY_NAMESPACE {

PreciseHit closest_of_precise(std::span<const PreciseTriangle> triangles, const PreciseRay& ray) {
  PreciseHit best;
  if (!within_limits(ray)) return best;
  const PreciseSheared sheared = shear(ray);
  for (const PreciseTriangle& triangle : triangles) closest_of(triangle, sheared, best);
  return best;
}

}  // namespace HWY_NAMESPACE
}  // namespace boxwood
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace boxwood {

HWY_EXPORT(closest_of_precise);

PreciseBruteForce::PreciseBruteForce(std::span<const DoubleVec3> vertices, std::span<const Triangle> triangles) {
  for (std::uint32_t i = 0; i < triangles.size(); ++i) {
    if (const auto triangle = precise_triangle(vertices, triangles[i], i)) triangles_.push_back(*triangle);
  }
}

PreciseHit PreciseBruteForce::closest_hit(const PreciseRay& ray) const {
  return HWY_DYNAMIC_DISPATCH(closest_of_precise)(triangles_, ray);
}

}  // namespace boxwood
#endif
