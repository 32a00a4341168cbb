#pragma once
// Meshes and rays in double precision.
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include "boxwood/precise.h"
#include "math/random.h"

namespace boxwood::test {

struct DoubleMesh {
  std::vector<DoubleVec3> vertices;
  std::vector<Triangle> triangles;
};

inline double length(const DoubleVec3& a) { return std::sqrt(a.x * a.x + a.y * a.y + a.z * a.z); }

/// In [-1, 1], with all bits of a double.
inline double random_double(Random& random) {
  const double high = random.uniform(-1, 1), low = random.uniform(-1, 1);
  return std::clamp(high + low * 0x1p-24, -1.0, 1.0);
}

inline DoubleVec3 random_double_point(Random& random, double size) {
  const double x = random_double(random), y = random_double(random);
  return DoubleVec3{x, y, random_double(random)} * size;
}

inline void append(DoubleMesh& mesh, const DoubleMesh& more) {
  const auto base = static_cast<std::uint32_t>(mesh.vertices.size());
  mesh.vertices.insert(mesh.vertices.end(), more.vertices.begin(), more.vertices.end());
  for (const auto& [a, b, c] : more.triangles) mesh.triangles.push_back({base + a, base + b, base + c});
}

/// Triangles of about `size` in a cube of half side `spread` around `center`; every tenth twice, for ties.
inline DoubleMesh double_soup(std::uint32_t count, double size, double spread, const DoubleVec3& center,
                              std::uint64_t seed) {
  Random random(seed);
  DoubleMesh mesh;
  for (std::uint32_t i = 0; i < count; ++i) {
    const DoubleVec3 at = center + random_double_point(random, spread);
    for (int corner = 0; corner < 3; ++corner) mesh.vertices.push_back(at + random_double_point(random, size));
    mesh.triangles.push_back({3 * i, 3 * i + 1, 3 * i + 2});
    if (i % 10 == 4) mesh.triangles.push_back(mesh.triangles.back());
  }
  return mesh;
}

/// Closed: the ball of radius `radius` around `center` whose surface is raised by height(unit vector).
template <class Height>
DoubleMesh relief(std::uint32_t rings, double radius, const DoubleVec3& center, const Height& height) {
  const double pi = std::acos(-1.0);
  DoubleMesh mesh;
  const auto add = [&](double theta, double phi) {
    const DoubleVec3 up{std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi), std::cos(theta)};
    mesh.vertices.push_back(center + up * (radius + height(up)));
  };
  const std::uint32_t columns = 2 * rings;
  add(0, 0);
  for (std::uint32_t ring = 1; ring < rings; ++ring) {
    for (std::uint32_t column = 0; column < columns; ++column) add(pi * ring / rings, 2 * pi * column / columns);
  }
  add(pi, 0);
  const auto south = static_cast<std::uint32_t>(mesh.vertices.size() - 1);
  const auto vertex = [&](std::uint32_t ring, std::uint32_t column) {
    return ring == 0 ? 0 : ring == rings ? south : 1 + (ring - 1) * columns + column % columns;
  };
  for (std::uint32_t ring = 0; ring < rings; ++ring) {
    for (std::uint32_t column = 0; column < columns; ++column) {
      const std::uint32_t a = vertex(ring, column), b = vertex(ring, column + 1);
      const std::uint32_t c = vertex(ring + 1, column), d = vertex(ring + 1, column + 1);
      if (ring > 0) mesh.triangles.push_back({a, d, b});
      if (ring + 1 < rings) mesh.triangles.push_back({a, c, d});
    }
  }
  return mesh;
}

inline constexpr double earth_radius = 6.371e6;  ///< metres

/// Mountains of up to some kilometres.
inline double earth_height(const DoubleVec3& up) {
  return 3000 * std::sin(31 * up.x) * std::sin(37 * up.y + 1) + 1500 * std::sin(83 * up.z) * std::cos(71 * up.x);
}

/// The Earth with a closed body of millimetre triangles, 0.2 m across, a metre above the surface.
struct Planet {
  DoubleMesh mesh;
  DoubleVec3 up, detail_center;  ///< away from the Earth's centre there; where the body is
  std::uint32_t first_detail = 0;
};

inline Planet planet(std::uint32_t rings, std::uint32_t detail_rings) {
  Planet out;
  out.mesh = relief(rings, earth_radius, {}, earth_height);
  out.first_detail = static_cast<std::uint32_t>(out.mesh.triangles.size());
  const DoubleVec3 way{0.3, -0.5, 0.8};
  out.up = way * (1 / length(way));
  out.detail_center = out.up * (earth_radius + 5000);
  append(out.mesh, relief(detail_rings, 0.1, out.detail_center,
                          [](const DoubleVec3& at) { return 0.004 * std::sin(40 * at.x) * std::cos(50 * at.y); }));
  return out;
}

/// From `origin` to points on triangles first … last, at edges and vertices as well.
inline std::vector<PreciseRay> rays_at(const DoubleMesh& mesh, std::uint32_t first, std::uint32_t last,
                                       const DoubleVec3& origin, double spread, std::uint32_t count,
                                       std::uint64_t seed) {
  Random random(seed);
  std::vector<PreciseRay> rays;
  for (std::uint32_t i = 0; i < count; ++i) {
    const auto& [a, b, c] = mesh.triangles[first + random.below(last - first)];
    double u = 0.5 + 0.5 * random_double(random), v = (1 - u) * (0.5 + 0.5 * random_double(random));
    if (i % 4 == 1) v = 0;
    if (i % 4 == 2) u = v = 0;
    const DoubleVec3 target = mesh.vertices[a] * (1 - u - v) + mesh.vertices[b] * u + mesh.vertices[c] * v;
    PreciseRay ray;
    ray.origin = origin + random_double_point(random, spread);
    ray.direction = target - ray.origin;
    rays.push_back(ray);
  }
  return rays;
}

}  // namespace boxwood::test
