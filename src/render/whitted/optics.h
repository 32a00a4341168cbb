#pragma once
#include <algorithm>
#include <cmath>

#include "boxwood/vec3.h"
#include "render/scattering.h"

namespace boxwood {

/// `incoming` travels towards the surface; both vectors are of unit length. Unit length.
inline Vec3 mirrored(const Vec3& incoming, const Vec3& normal) {
  return incoming - normal * (2 * dot(incoming, normal));
}

/// Which way light goes on behind a smooth surface, and how much of it does not.
struct Refraction {
  Vec3 direction;         ///< unit length; that of `incoming` on total reflection
  float reflectance = 1;  ///< share that is mirrored, in [0, 1]
};

/// Snell's law and Fresnel's equations for unpolarised light, the mean of both polarisations' reflected power.
/// `normal` points against `incoming`; `ratio` is the refraction index of the side it comes from over that of the
/// other. Total reflection where Snell's law has no solution. Spec 003, 2.10.
inline Refraction refracted(const Vec3& incoming, const Vec3& normal, float ratio) {
  const float cosine = std::min(1.0f, -dot(incoming, normal));
  const float sine_squared = ratio * ratio * std::max(0.0f, 1 - cosine * cosine);
  if (sine_squared >= 1) return {incoming, 1};
  const float behind = std::sqrt(1 - sine_squared);
  const Vec3 direction = normalize(incoming * ratio + normal * (ratio * cosine - behind));
  return {direction, std::min(1.0f, fresnel_reflectance(cosine, ratio))};
}

}  // namespace boxwood
