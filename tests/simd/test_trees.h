// Small scenes, rays and trees that reach the corners of the kernels.
#pragma once
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numeric>
#include <random>
#include <string_view>
#include <vector>

#include "boxwood/scene.h"
#include "tree/tree.h"

namespace boxwood {

inline constexpr std::array test_scene_names = {"random",       "grid",  "coplanar_stack",
                                                "one_triangle", "empty", "far_away"};

/// Deterministic on every standard library, unlike std::uniform_real_distribution.
class TestRandom {
 public:
  explicit TestRandom(std::uint32_t seed) : engine_(seed) {}
  float between(float low, float high) { return low + (high - low) * (static_cast<float>(engine_() >> 8) * 0x1p-24f); }
  Vec3 point(float low, float high) {
    const float x = between(low, high), y = between(low, high);
    return {x, y, between(low, high)};
  }

 private:
  std::mt19937 engine_;
};

inline void add_triangle(std::vector<Vec3>& positions, std::vector<Triangle>& triangles, Vec3 a, Vec3 b, Vec3 c) {
  const auto first = static_cast<std::uint32_t>(positions.size());
  positions.insert(positions.end(), {a, b, c});
  triangles.push_back({first, first + 1, first + 2});
}

/// `grid` shares vertices, for rays through edges; `coplanar_stack` repeats each triangle, for ties.
inline Scene test_scene(std::string_view name) {
  std::vector<Vec3> positions;
  std::vector<Triangle> triangles;
  TestRandom random(7);
  if (name == "random" || name == "far_away") {
    const Vec3 offset = name == "random" ? Vec3{0, 0, 0} : Vec3{3e4f, -7e4f, 1e4f};
    for (int i = 0; i < 700; ++i) {
      const Vec3 center = random.point(-1, 1) + offset;
      const Vec3 a = random.point(-0.1f, 0.1f), b = random.point(-0.1f, 0.1f), c = random.point(-0.1f, 0.1f);
      add_triangle(positions, triangles, center + a, center + b, center + c);
    }
  } else if (name == "grid") {
    constexpr std::uint32_t side = 20;
    for (std::uint32_t y = 0; y <= side; ++y) {
      for (std::uint32_t x = 0; x <= side; ++x) {
        positions.push_back(
            {static_cast<float>(x) / 10 - 1, static_cast<float>(y) / 10 - 1, random.between(-0.1f, 0.1f)});
      }
    }
    for (std::uint32_t y = 0; y < side; ++y) {
      for (std::uint32_t x = 0; x < side; ++x) {
        const std::uint32_t corner = y * (side + 1) + x;
        triangles.push_back({corner, corner + 1, corner + side + 1});
        triangles.push_back({corner + 1, corner + side + 2, corner + side + 1});
      }
    }
  } else if (name == "coplanar_stack") {
    for (int i = 0; i < 60; ++i) {
      const float x = static_cast<float>(i % 6) * 0.3f - 1;
      add_triangle(positions, triangles, {x, -1, 0.25f}, {x + 0.5f, -1, 0.25f}, {x, 1, 0.25f});
    }
  } else if (name == "one_triangle") {
    add_triangle(positions, triangles, {0, 0, 0}, {1, 0, 0}, {0, 1, 0});
  }
  Scene scene;
  scene.add_mesh(std::move(positions), std::move(triangles));
  return scene;
}

/// Rays at vertices, edges and anywhere; parallel to axes; with limits, negative ones included; and some that must hit
/// nothing.
inline std::vector<Ray> test_rays(const Scene& scene) {
  constexpr float infinity = std::numeric_limits<float>::infinity();
  const Mesh& mesh = scene.meshes.front();
  const Vec3 center = mesh.positions.empty() ? Vec3{} : scene.bounds().center();
  TestRandom random(11);
  std::vector<Ray> rays;
  const auto towards = [&](const Vec3& target) {
    const Vec3 origin = center + random.point(-2, 2);
    rays.push_back({origin, 0, target - origin});
  };
  for (int i = 0; i < 300; ++i) towards(center + random.point(-1, 1));
  for (std::size_t i = 0; i < mesh.triangles.size(); i += mesh.triangles.size() / 100 + 1) {
    const Vec3 a = mesh.positions[mesh.triangles[i][0]], b = mesh.positions[mesh.triangles[i][1]];
    towards(a);
    towards((a + b) * 0.5f);
    rays.push_back({a, 0, random.point(-1, 1)});
    rays.push_back({{a.x, a.y, center.z - 3}, 0, {0, 0, 1}});
    rays.push_back({{center.x - 3, b.y, b.z}, 0, {1, 0, -0.0f}});
  }
  for (int i = 0; i < 200; ++i) {
    const Vec3 origin = center + random.point(-1, 1);
    const float from = random.between(-2, 1);
    rays.push_back({origin, from, random.point(-1, 1), from + random.between(0, 2)});
    rays.push_back({origin, -infinity, random.point(-1e-3f, 1e-3f), random.between(-100, 100)});
    rays.push_back({origin, -0.0f, random.point(-1e6f, 1e6f), infinity});
  }
  // A group that shares an origin and nearly a direction, as a camera's tile does; long enough for every packet.
  for (int i = 0; i < 256; ++i) {
    const Vec3 target{random.between(-0.3f, 0.3f), random.between(-0.3f, 0.3f), random.between(-0.1f, 0.1f)};
    rays.push_back({center + Vec3{-3, -4, -5}, 0, Vec3{3, 4, 5} + target});
  }
  // Groups whose dominant axis is a tie.
  for (int i = 0; i < 192; ++i) {
    const float other = random.between(0.5f, 0.55f);
    const Vec3 direction = i < 64 ? Vec3{1, other, 1} : i < 128 ? Vec3{1, -1, other} : Vec3{other, -1, -1};
    rays.push_back({center - direction * 3 + random.point(-0.1f, 0.1f), 0, direction, 100});
  }
  const float nan = std::numeric_limits<float>::quiet_NaN();
  rays.push_back({center, 0, {0, 0, 0}});
  rays.push_back({center, 0, {nan, 0, 1}});
  rays.push_back({center, 0, {infinity, 0, 1}});
  rays.push_back({center, nan, {1, 0, 1}});
  rays.push_back({center, 1, {1, 0, 1}, 0.5f});
  rays.push_back({{nan, 0, 0}, 0, {1, 0, 1}});
  return rays;
}

/// Splits by the median of the longest axis into `arity` parts until at most `leaf` triangles are left: those nearly,
/// since the last split makes no more parts than it takes.
inline Tree test_tree(const Mesh& mesh, std::uint32_t arity, std::uint32_t leaf) {
  Tree tree;
  for (std::uint32_t i = 0; i < mesh.triangles.size(); ++i) {
    if (is_usable(mesh, i)) tree.references.push_back(i);
  }
  if (tree.references.empty()) return tree;
  const auto bounds_of = [&](std::uint32_t primitive) {
    Box box;
    for (const std::uint32_t vertex : mesh.triangles[primitive]) box.grow(mesh.positions[vertex]);
    return box;
  };
  const auto make_node = [&](std::uint32_t first, std::uint32_t count) {
    Tree::Node node;
    for (std::uint32_t i = 0; i < count; ++i) node.bounds.grow(bounds_of(tree.references[first + i]));
    node.first = first;
    node.count = count & Tree::max_count;
    node.leaf = 1;
    return node;
  };
  tree.nodes.push_back(make_node(0, static_cast<std::uint32_t>(tree.references.size())));
  for (std::size_t i = 0; i < tree.nodes.size(); ++i) {
    const std::uint32_t first = tree.nodes[i].first, count = tree.nodes[i].count;
    if (count <= leaf) continue;
    const auto axis = static_cast<std::size_t>(longest_axis(tree.nodes[i].bounds.extent()));
    std::sort(
        tree.references.begin() + first, tree.references.begin() + first + count,
        [&](std::uint32_t a, std::uint32_t b) { return bounds_of(a).center()[axis] < bounds_of(b).center()[axis]; });
    const std::uint32_t parts = std::min(arity, (count + leaf - 1) / leaf);
    tree.nodes[i].first = static_cast<std::uint32_t>(tree.nodes.size());
    tree.nodes[i].count = parts & Tree::max_count;
    tree.nodes[i].leaf = 0;
    for (std::uint32_t p = 0; p < parts; ++p) {
      const std::uint32_t begin = count * p / parts, end = count * (p + 1) / parts;
      tree.nodes.push_back(make_node(first + begin, end - begin));
    }
  }
  return tree;
}

}  // namespace boxwood
