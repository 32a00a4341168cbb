#include "build/hit_lists.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>

namespace boxwood {
namespace {

/// Moller and Trumbore 1997, in double.
bool hits(const Ray& ray, const Vec3 (&corners)[3]) {
  struct V {
    double x, y, z;
  };
  const auto minus = [](const Vec3& a, const Vec3& b) {
    return V{double{a.x} - b.x, double{a.y} - b.y, double{a.z} - b.z};
  };
  const auto cross_of = [](const V& a, const V& b) {
    return V{a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
  };
  const auto dot_of = [](const V& a, const V& b) { return a.x * b.x + a.y * b.y + a.z * b.z; };
  const V direction{ray.direction.x, ray.direction.y, ray.direction.z};
  const V first = minus(corners[1], corners[0]), second = minus(corners[2], corners[0]);
  const V p = cross_of(direction, second);
  const double determinant = dot_of(first, p);
  if (determinant == 0) return false;
  const V from = minus(ray.origin, corners[0]);
  const double u = dot_of(from, p) / determinant;
  const V q = cross_of(from, first);
  const double v = dot_of(direction, q) / determinant, t = dot_of(second, q) / determinant;
  return u >= 0 && v >= 0 && u + v <= 1 && t >= double{ray.t_near} && t <= double{ray.t_far};
}

std::vector<std::uint32_t> hits_of(const Tree& tree, const Geometry& geometry, const Ray& ray, const Segment& segment) {
  std::vector<std::uint32_t> found, stack;
  if (!tree.empty()) stack.push_back(0);
  while (!stack.empty()) {
    const Tree::Node& node = tree.nodes[stack.back()];
    stack.pop_back();
    if (!segment.meets(node.bounds)) continue;
    for (std::uint32_t i = 0; i < node.count; ++i) {
      if (!node.is_leaf()) {
        stack.push_back(node.first + i);
        continue;
      }
      Vec3 corners[3];
      const std::uint32_t primitive = tree.references[node.first + i];
      if (geometry.corners(primitive, corners) && hits(ray, corners)) found.push_back(primitive);
    }
  }
  std::ranges::sort(found);
  found.erase(std::unique(found.begin(), found.end()), found.end());
  return found;
}

}  // namespace

SegmentHits hit_lists(const Tree& tree, const Geometry& geometry, const KnownUse& use) {
  const bool have_any_hit = std::ranges::any_of(
      use.rays, [](const ExpectedRays& rays) { return rays.query == Query::any_hit && !rays.rays.empty(); });
  std::vector<Ray> rays;
  for (const ExpectedRays& set : use.rays) {
    if (have_any_hit && set.query != Query::any_hit) continue;
    rays.insert(rays.end(), set.rays.begin(), set.rays.end());
  }
  SegmentHits lists;
  for (const Ray& ray : rays) lists.rays.emplace_back(ray, ray.t_far);
  std::vector<std::vector<std::uint32_t>> found(rays.size());
  tbb::parallel_for(std::size_t{0}, rays.size(),
                    [&](std::size_t i) { found[i] = hits_of(tree, geometry, rays[i], lists.rays[i]); });
  lists.begin.push_back(0);
  for (const std::vector<std::uint32_t>& of_ray : found) {
    lists.primitives.insert(lists.primitives.end(), of_ray.begin(), of_ray.end());
    lists.begin.push_back(static_cast<std::uint32_t>(lists.primitives.size()));
  }
  return lists;
}

}  // namespace boxwood
