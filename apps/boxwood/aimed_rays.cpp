#include "aimed_rays.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <numeric>

#include "math/random.h"

namespace boxwood::cli {
namespace {

std::vector<std::uint32_t> usable_triangles(const Mesh& mesh) {
  std::vector<std::uint32_t> out;
  for (std::uint32_t i = 0; i < mesh.triangles.size(); ++i) {
    if (is_usable(mesh, i)) out.push_back(i);
  }
  return out;
}

Vec3 random_point(const Box& box, Random& random) {
  const Vec3 e = box.extent();
  return box.lower + Vec3{e.x * random.uniform(), e.y * random.uniform(), e.z * random.uniform()};
}

/// A vertex, or as often a point on an edge, of a random triangle of `triangles`.
Vec3 weak_point(const Mesh& mesh, const std::vector<std::uint32_t>& triangles, Random& random) {
  const Triangle& triangle = mesh.triangles[triangles[random.below(static_cast<std::uint32_t>(triangles.size()))]];
  const std::uint32_t corner = random.below(3);
  const Vec3& from = mesh.positions[triangle[corner]];
  if (random.below(2) == 0) return from;
  const Vec3& to = mesh.positions[triangle[(corner + 1) % 3]];
  return from + (to - from) * random.uniform();
}

/// Number of the first position of equal coordinates, for every position.
std::vector<std::uint32_t> weld(const Mesh& mesh) {
  const auto key = [&](std::uint32_t i) {
    const Vec3& p = mesh.positions[i];
    return std::array{p.x, p.y, p.z};
  };
  std::vector<std::uint32_t> order(mesh.positions.size());
  std::iota(order.begin(), order.end(), 0u);
  // Positions that are not finite have no order; no usable triangle has one.
  std::erase_if(order, [&](std::uint32_t i) { return !is_finite(mesh.positions[i]); });
  std::ranges::sort(order,
                    [&](std::uint32_t a, std::uint32_t b) { return key(a) != key(b) ? key(a) < key(b) : a < b; });
  std::vector<std::uint32_t> first(mesh.positions.size());
  for (std::size_t i = 0; i < order.size(); ++i) {
    first[order[i]] = i > 0 && key(order[i]) == key(order[i - 1]) ? first[order[i - 1]] : order[i];
  }
  return first;
}

/// Whether every edge is used as often in one direction as in the other, so that winding numbers are whole.
bool is_closed(const Mesh& mesh, const std::vector<std::uint32_t>& triangles) {
  struct Edge {
    std::uint32_t low, high;
    int direction;
  };
  const std::vector<std::uint32_t> welded = weld(mesh);
  std::vector<Edge> edges;
  for (const std::uint32_t t : triangles) {
    for (std::size_t corner = 0; corner < 3; ++corner) {
      const std::uint32_t a = welded[mesh.triangles[t][corner]], b = welded[mesh.triangles[t][(corner + 1) % 3]];
      edges.push_back({std::min(a, b), std::max(a, b), a < b ? 1 : -1});
    }
  }
  const auto same = [](const Edge& a, const Edge& b) { return a.low == b.low && a.high == b.high; };
  std::ranges::sort(edges,
                    [](const Edge& a, const Edge& b) { return a.low != b.low ? a.low < b.low : a.high < b.high; });
  int balance = 0;
  for (std::size_t i = 0; i < edges.size(); ++i) {
    balance += edges[i].direction;
    const bool last_of_edge = i + 1 == edges.size() || !same(edges[i], edges[i + 1]);
    if (last_of_edge && balance != 0) return false;
  }
  return !edges.empty();
}

struct Point {
  double x, y, z;
};

Point between(const Vec3& from, const Vec3& to) {
  return {double{to.x} - double{from.x}, double{to.y} - double{from.y}, double{to.z} - double{from.z}};
}
double dot(const Point& a, const Point& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
Point cross(const Point& a, const Point& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

/// How often a closed mesh goes around a point. Solid angles by Van Oosterom and Strackee 1983.
double winding_number(const Mesh& mesh, const std::vector<std::uint32_t>& triangles, const Vec3& point) {
  double angle = 0;
  for (const std::uint32_t t : triangles) {
    const Point a = between(point, mesh.positions[mesh.triangles[t][0]]);
    const Point b = between(point, mesh.positions[mesh.triangles[t][1]]);
    const Point c = between(point, mesh.positions[mesh.triangles[t][2]]);
    const double la = std::sqrt(dot(a, a)), lb = std::sqrt(dot(b, b)), lc = std::sqrt(dot(c, c));
    angle += 2 * std::atan2(dot(a, cross(b, c)), la * lb * lc + dot(a, b) * lc + dot(b, c) * la + dot(c, a) * lb);
  }
  return angle / (4 * std::numbers::pi);
}

/// Random points of the box, and points a little off the surface for meshes that fill little of theirs.
std::vector<Vec3> points_inside(const Mesh& mesh, const std::vector<std::uint32_t>& triangles, Random& random) {
  constexpr std::size_t most_triangle_visits = 30'000'000;  // about a second
  const std::size_t tries = std::clamp<std::size_t>(most_triangle_visits / triangles.size(), 4, 64);
  Box box;
  for (const std::uint32_t t : triangles) {
    for (const std::uint32_t vertex : mesh.triangles[t]) box.grow(mesh.positions[vertex]);
  }
  const float diagonal = length(box.extent());
  std::vector<Vec3> inside;
  for (std::size_t i = 0; i < tries; ++i) {
    Vec3 point = random_point(box, random);
    if (i % 2 == 1) {
      const Triangle& triangle = mesh.triangles[triangles[random.below(static_cast<std::uint32_t>(triangles.size()))]];
      const Vec3 &a = mesh.positions[triangle[0]], &b = mesh.positions[triangle[1]], &c = mesh.positions[triangle[2]];
      const Vec3 normal = normalize(boxwood::cross(b - a, c - a));
      point = (a + b + c) * (1.0f / 3) - normal * (diagonal * random.uniform(0.001f, 0.05f));
    }
    if (std::fabs(winding_number(mesh, triangles, point)) > 0.5) inside.push_back(point);
  }
  return inside;
}

}  // namespace

std::vector<Ray> rays_at_edges(const Scene& scene, std::uint32_t count, std::uint64_t seed) {
  std::vector<std::vector<std::uint32_t>> usable;
  for (const Mesh& mesh : scene.meshes) usable.push_back(usable_triangles(mesh));
  std::vector<std::uint32_t> targets;
  for (std::uint32_t i = 0; i < scene.instances.size(); ++i) {
    if (!usable[scene.instances[i].mesh].empty()) targets.push_back(i);
  }
  if (targets.empty()) return {};
  Box origins = scene.bounds();
  const Vec3 margin = origins.extent() * 0.25f;
  origins = {origins.lower - margin, origins.upper + margin};
  std::vector<Ray> rays;
  for (std::uint32_t i = 0; i < count; ++i) {
    Random random(seed, i);
    const Instance& instance = scene.instances[targets[random.below(static_cast<std::uint32_t>(targets.size()))]];
    const Vec3 target =
        instance.object_to_world.point(weak_point(scene.meshes[instance.mesh], usable[instance.mesh], random));
    Ray ray;
    ray.origin = random_point(origins, random);
    ray.direction = target - ray.origin;
    rays.push_back(ray);
  }
  return rays;
}

InsideRays rays_from_inside(const Scene& scene, std::uint32_t count, std::uint64_t seed) {
  InsideRays result;
  const auto share = static_cast<std::uint32_t>(count / std::max<std::size_t>(1, scene.meshes.size()) + 1);
  for (std::uint32_t m = 0; m < scene.meshes.size(); ++m) {
    const Mesh& mesh = scene.meshes[m];
    const auto instance = std::ranges::find(scene.instances, m, &Instance::mesh);
    const std::vector<std::uint32_t> triangles = usable_triangles(mesh);
    if (instance == scene.instances.end() || !is_closed(mesh, triangles)) continue;
    ++result.closed_meshes;
    Random random(seed, m);
    const std::vector<Vec3> origins = points_inside(mesh, triangles, random);
    if (origins.empty()) continue;
    for (std::uint32_t i = 0; i < share && result.rays.size() < count; ++i) {
      Ray ray;
      ray.origin = instance->object_to_world.point(origins[i % origins.size()]);
      ray.direction = instance->object_to_world.point(weak_point(mesh, triangles, random)) - ray.origin;
      result.rays.push_back(ray);
    }
  }
  return result;
}

}  // namespace boxwood::cli
