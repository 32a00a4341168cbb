#pragma once
#include <algorithm>
#include <vector>

#include "boxwood/ray.h"
#include "boxwood/scene.h"

namespace boxwood {

/// Where a ray hit and what it hit, in world space.
struct SurfacePoint {
  Vec3 position;
  /// Of the flat triangle, unit length, towards the side from which its vertices run counter-clockwise. An instance
  /// keeps the sides of its mesh, even when it mirrors.
  Vec3 normal;
  float clearance = 0;  ///< a distance off the surface at which rounding can no longer hit it again
  const Material* material = nullptr;
  Vec3 diffuse;  ///< the material's, times its texture here
};

/// The largest component of a colour.
inline float largest(const Vec3& color) { return std::max({color.x, color.y, color.z}); }

/// Looks up the surface behind a hit. Depends on the mesh and on the hit's instance, primitive, u and v only, computed
/// in double and rounded once, so shading is the same whichever structure found the hit. Refers to the scene.
class Surfaces {
 public:
  explicit Surfaces(const Scene& scene) : scene_(scene) {}

  /// `hit` must be valid.
  SurfacePoint at(const Hit& hit) const { return at(hit.instance, hit.primitive, hit.u, hit.v); }
  /// Point with barycentric weights 1 - u - v, u, v on a usable triangle of an instance.
  SurfacePoint at(std::uint32_t instance, std::uint32_t primitive, float u, float v) const;
  /// Of a triangle; one that has none is a grey diffuse one.
  const Material& material(std::uint32_t instance, std::uint32_t primitive) const;

 private:
  Vec3 diffuse(const Mesh& mesh, const Triangle& triangle, const Material& material, float u, float v) const;

  const Scene& scene_;
  Material fallback_;  // of triangles without one
};

/// `normal` or its opposite, whichever points against `incoming`.
constexpr Vec3 facing(const Vec3& normal, const Vec3& incoming) { return dot(normal, incoming) > 0 ? -normal : normal; }

}  // namespace boxwood
