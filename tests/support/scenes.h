#pragma once
// Small scenes whose trouble is known.
#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

#include "boxwood/scene.h"
#include "math/random.h"

namespace boxwood::test {

struct NamedScene {
  std::string name;
  Scene scene;
};

inline Vec3 random_point(Random& random, float size) {
  const float x = random.uniform(-size, size), y = random.uniform(-size, size);
  return {x, y, random.uniform(-size, size)};
}

inline Scene scene_of(std::vector<Vec3> positions, std::vector<Triangle> triangles) {
  Scene scene;
  scene.add_mesh(std::move(positions), std::move(triangles));
  return scene;
}

/// Triangles of about `size` scattered in a cube of half side 1, then everything times `scale` plus `offset`.
inline Scene soup(std::uint32_t count, float size, std::uint64_t seed, float scale = 1, Vec3 offset = {}) {
  Random random(seed);
  std::vector<Vec3> positions;
  std::vector<Triangle> triangles;
  for (std::uint32_t i = 0; i < count; ++i) {
    const Vec3 center = random_point(random, 1);
    for (int corner = 0; corner < 3; ++corner) {
      positions.push_back((center + random_point(random, size)) * scale + offset);
    }
    triangles.push_back({3 * i, 3 * i + 1, 3 * i + 2});
  }
  return scene_of(std::move(positions), std::move(triangles));
}

/// A grid of (columns + 1) x (rows + 1) vertices where surface(u, v) puts them; u, v in [0, 1].
template <class Surface>
Scene sheet(std::uint32_t columns, std::uint32_t rows, const Surface& surface) {
  std::vector<Vec3> positions;
  std::vector<Triangle> triangles;
  for (std::uint32_t j = 0; j <= rows; ++j) {
    for (std::uint32_t i = 0; i <= columns; ++i) {
      positions.push_back(surface(static_cast<float>(i) / static_cast<float>(columns),
                                  static_cast<float>(j) / static_cast<float>(rows)));
    }
  }
  for (std::uint32_t j = 0; j < rows; ++j) {
    for (std::uint32_t i = 0; i < columns; ++i) {
      const std::uint32_t a = j * (columns + 1) + i, b = a + 1, c = a + columns + 1, d = c + 1;
      triangles.push_back({a, b, d});
      triangles.push_back({a, d, c});
    }
  }
  return scene_of(std::move(positions), std::move(triangles));
}

/// Makes vertices at the same place the same vertex, so that a wrapped sheet is closed. O(n²).
inline void weld(Mesh& mesh, float distance) {
  std::vector<std::uint32_t> first(mesh.positions.size());
  for (std::uint32_t i = 0; i < first.size(); ++i) {
    for (first[i] = 0; first[i] < i && !(length(mesh.positions[first[i]] - mesh.positions[i]) <= distance);) ++first[i];
  }
  for (Triangle& triangle : mesh.triangles) {
    for (std::uint32_t& vertex : triangle) vertex = first[vertex];
  }
}

inline constexpr float full_turn = 6.28318530717958647692f;

/// Closed sphere of radius 1 about the origin; poles are one vertex each.
inline Scene sphere(std::uint32_t rings) {
  Scene scene = sheet(2 * rings, rings, [](float u, float v) {
    const float phi = u * full_turn, theta = v * full_turn / 2, ring = std::sin(theta);
    return Vec3{ring * std::cos(phi), ring * std::sin(phi), std::cos(theta)};
  });
  weld(scene.meshes[0], 1e-5f);
  return scene;
}

/// Closed torus of radii 1 and 0.4 in the xy plane.
inline Scene torus(std::uint32_t rings) {
  Scene scene = sheet(2 * rings, rings, [](float u, float v) {
    const float phi = u * full_turn, theta = v * full_turn, radius = 1 + 0.4f * std::cos(theta);
    return Vec3{radius * std::cos(phi), radius * std::sin(phi), 0.4f * std::sin(theta)};
  });
  weld(scene.meshes[0], 1e-5f);
  return scene;
}

/// Closed axis-aligned cube of half side 1, every face a grid.
inline Scene cube(std::uint32_t cells) {
  std::vector<Vec3> positions;
  std::vector<Triangle> triangles;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    for (const float side : {-1.0f, 1.0f}) {
      const Scene face = sheet(cells, cells, [&](float u, float v) {
        Vec3 p;
        p[axis] = side, p[(axis + 1) % 3] = 2 * u - 1, p[(axis + 2) % 3] = 2 * v - 1;
        return p;
      });
      const auto base = static_cast<std::uint32_t>(positions.size());
      positions.insert(positions.end(), face.meshes[0].positions.begin(), face.meshes[0].positions.end());
      for (const auto& [a, b, c] : face.meshes[0].triangles) triangles.push_back({base + a, base + b, base + c});
    }
  }
  Scene scene = scene_of(std::move(positions), std::move(triangles));
  weld(scene.meshes[0], 0);
  return scene;
}

inline Scene transformed(Scene scene, float scale, Vec3 offset) {
  for (Mesh& mesh : scene.meshes) {
    for (Vec3& p : mesh.positions) p = p * scale + offset;
  }
  return scene;
}

/// A soup and a sphere, placed ten times by moves, turns, mirrors, stretches and a shear; some overlap exactly.
inline Scene instances() {
  Scene scene = soup(40, 0.3f, 11);
  scene.meshes.push_back(sphere(6).meshes[0]);
  scene.instances.clear();
  Random random(5);
  for (std::uint32_t i = 0; i < 10; ++i) {
    const Transform turn = Transform::rotate(normalize(random_point(random, 1)), random.uniform(0, full_turn));
    const Vec3 stretch{i % 3 == 0 ? -1.0f : 1.0f, i % 4 == 1 ? 20.0f : 1.0f, i % 4 == 2 ? 0.01f : 1.0f};
    scene.instances.push_back(
        {i % 2, Transform::translate(random_point(random, 4)) * turn * Transform::scale(stretch) * turn});
  }
  scene.instances.push_back(scene.instances[3]);
  scene.instances.push_back({1, Transform{{1, 0, 0}, {3, 1, 0}, {0, 2, 1}, {2, -1, 0}}});
  return scene;
}

inline Scene coincident(std::uint32_t count) {
  std::vector<Triangle> triangles(count, Triangle{0, 1, 2});
  return scene_of({{0, 0, 0}, {1, 0.25f, 0}, {0, 1, 0.5f}}, std::move(triangles));
}

/// Triangles that cannot be used among ones that can.
inline Scene with_unusable() {
  Scene scene = soup(30, 0.4f, 3);
  Mesh& mesh = scene.meshes[0];
  mesh.positions[0].x = std::numeric_limits<float>::quiet_NaN();
  mesh.positions[10].y = std::numeric_limits<float>::infinity();
  mesh.positions[20] = {1e30f, 0, 0};
  mesh.triangles[12] = {36, 36, 37};
  mesh.triangles[13] = {39, 39, 39};
  return scene;
}

/// Every kind of trouble, few triangles each.
inline std::vector<NamedScene> troubled_scenes() {
  std::vector<NamedScene> out;
  out.push_back({"none", scene_of({}, {})});
  out.push_back({"one", soup(1, 0.5f, 1)});
  out.push_back({"two", soup(2, 0.5f, 2)});
  out.push_back({"soup", soup(300, 0.2f, 7)});
  out.push_back({"overlapping", soup(60, 2.0f, 8)});
  out.push_back({"unusable", with_unusable()});
  out.push_back({"coincident", coincident(50)});
  out.push_back({"coplanar", sheet(8, 8, [](float u, float v) { return Vec3{2 * u - 1, 2 * v - 1, 0}; })});
  out.push_back({"slivers", soup(100, 0.2f, 9)});
  for (Vec3& p : out.back().scene.meshes[0].positions) p.y *= 1e-6f;
  out.push_back({"cube", cube(4)});
  out.push_back({"sphere", sphere(8)});
  out.push_back({"torus", torus(8)});
  out.push_back({"tiny", soup(100, 0.3f, 12, 1e-6f)});
  out.push_back({"huge", soup(100, 0.3f, 13, 1e9f)});
  out.push_back({"limit", soup(60, 0.3f, 15, 5e11f)});
  out.push_back({"vanishing", soup(60, 0.3f, 16, 1e-14f)});
  out.push_back({"far away", soup(100, 0.3f, 14, 1.0f, {1e5f, -3e5f, 2e4f})});
  out.push_back({"instances", instances()});
  return out;
}

}  // namespace boxwood::test
