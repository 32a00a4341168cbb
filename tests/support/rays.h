#pragma once
// Rays that look for trouble in a scene.
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

#include "boxwood/ray.h"
#include "boxwood/scene.h"
#include "math/random.h"
#include "support/scenes.h"

namespace boxwood::test {

/// The box rays start around; a unit cube for a scene without triangles.
inline Box arena_of(const Scene& scene) {
  const Box bounds = scene.bounds();
  return bounds.empty() ? Box{{-1, -1, -1}, {1, 1, 1}} : bounds;
}

inline Vec3 point_around(const Box& box, Random& random, float spread) {
  const Vec3 center = box.center();
  const float size = std::max({box.extent().x, box.extent().y, box.extent().z, 1e-30f});
  return center + random_point(random, spread * size);
}

/// A world-space vertex of some triangle of some instance; the origin for an empty scene.
inline Vec3 some_vertex(const Scene& scene, Random& random) {
  for (int attempt = 0; attempt < 100 && !scene.instances.empty(); ++attempt) {
    const Instance& instance = scene.instances[random.below(static_cast<std::uint32_t>(scene.instances.size()))];
    const Mesh& mesh = scene.meshes[instance.mesh];
    if (mesh.triangles.empty()) continue;
    const std::uint32_t t = random.below(static_cast<std::uint32_t>(mesh.triangles.size()));
    if (is_usable(mesh, t)) return instance.object_to_world.point(mesh.positions[mesh.triangles[t][random.below(3)]]);
  }
  return {};
}

/// A few units in the last place to either side.
inline float jitter(float value, Random& random) {
  for (std::uint32_t n = random.below(4); n > 0; --n) {
    value = std::nextafter(
        value, random.below(2) ? std::numeric_limits<float>::infinity() : -std::numeric_limits<float>::infinity());
  }
  return value;
}

inline Vec3 jitter(const Vec3& v, Random& random) {
  const float x = jitter(v.x, random), y = jitter(v.y, random);
  return {x, y, jitter(v.z, random)};
}

/// A component that a careless slab or shear test trips over.
inline float awkward_component(Random& random) {
  constexpr float values[] = {0.0f, -0.0f, 1.0f, -1.0f, 1e-45f, -1e-40f, 1e-38f, -1e-30f, 1e-20f, -1e-10f, 1e-7f};
  return values[random.below(std::size(values))];
}

inline void limit_range(Ray& ray, float size, Random& random) {
  const float unit = size / std::max(length(ray.direction), 1e-12f);
  if (random.below(3) == 0) ray.t_near = random.uniform(-1, 2) * unit;
  if (random.below(3) == 0) ray.t_far = std::max(ray.t_near, random.uniform(0, 4) * unit);
}

/// `count` rays of mixed kinds: random ones, ones aimed at vertices and at edges and jittered by ulps, axis-aligned
/// ones in the planes of the geometry, awkward directions, directions of any length, limited ranges.
inline std::vector<Ray> troubling_rays(const Scene& scene, std::uint32_t count, std::uint64_t seed) {
  const Box box = arena_of(scene);
  const float size = std::max({box.extent().x, box.extent().y, box.extent().z, 1e-30f});
  Random random(seed);
  std::vector<Ray> rays;
  for (std::uint32_t i = 0; i < count; ++i) {
    Ray ray;
    ray.origin = point_around(box, random, i % 2 ? 0.5f : 2.0f);
    const Vec3 vertex = some_vertex(scene, random), other = some_vertex(scene, random);
    switch (i % 6) {
      case 0:
        ray.direction = random_point(random, 1);
        break;
      case 1:
        ray.direction = jitter((vertex - ray.origin) * (1 / size), random);
        break;
      case 2:
        ray.direction = vertex + (other - vertex) * random.uniform() - ray.origin;
        break;
      case 3:  // along an axis, in the plane of a vertex
        ray.origin[random.below(3)] = vertex[random.below(3)];
        ray.origin = random.below(2) ? vertex + Vec3{size, 0, 0} : ray.origin;
        ray.direction[random.below(3)] = random.below(2) ? 1.0f : -1.0f;
        break;
      case 4:
        ray.origin = random.below(2) ? vertex : ray.origin;
        for (std::size_t axis = 0; axis < 3; ++axis) ray.direction[axis] = awkward_component(random);
        break;
      case 5:  // from a vertex to a vertex: along edges and coplanar triangles
        ray.origin = vertex;
        ray.direction = other - vertex;
        break;
    }
    const float longest =
        std::max({std::fabs(ray.direction.x), std::fabs(ray.direction.y), std::fabs(ray.direction.z), 1e-30f});
    constexpr float scales[] = {1, 1, 1, 1e-6f, 1e6f, 1e-11f, 1e11f};
    if (longest > 1e-20f) ray.direction = ray.direction * (1 / longest) * scales[random.below(std::size(scales))];
    limit_range(ray, size, random);
    rays.push_back(ray);
  }
  return rays;
}

/// Rays that hit nothing by definition.
inline std::vector<Ray> invalid_rays(const Vec3& origin, const Vec3& direction) {
  constexpr float nan = std::numeric_limits<float>::quiet_NaN(), infinity = std::numeric_limits<float>::infinity();
  std::vector<Ray> rays;
  for (const float bad : {nan, infinity, -infinity, 1e13f, -1e13f}) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      rays.push_back({origin, 0, direction, infinity});
      rays.back().origin[axis] = bad;
      rays.push_back({origin, 0, direction, infinity});
      rays.back().direction[axis] = bad;
    }
  }
  rays.push_back({origin, 0, {0, 0, 0}, infinity});
  rays.push_back({origin, 0, {-0.0f, 0, -0.0f}, infinity});
  rays.push_back({origin, 0, {1e-13f, 0, 1e-20f}, infinity});
  rays.push_back({origin, 1, direction, 0.5f});
  rays.push_back({origin, nan, direction, infinity});
  rays.push_back({origin, 0, direction, nan});
  rays.push_back({origin, infinity, direction, -infinity});
  return rays;
}

}  // namespace boxwood::test
