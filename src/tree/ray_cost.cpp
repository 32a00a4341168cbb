#include "tree/ray_cost.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_reduce.h>

#include <cmath>
#include <functional>
#include <vector>

#include "math/random.h"
#include "math/sampling.h"

namespace boxwood {
namespace {

/// Whole numbers, so that the order of summing does not matter.
struct Visits {
  std::uint64_t inner = 0, leaves = 0, leaves_squared = 0, references = 0;
  Visits operator+(const Visits& other) const {
    return {inner + other.inner, leaves + other.leaves, leaves_squared + other.leaves_squared,
            references + other.references};
  }
};

Visits visits_of(const Tree& tree, const Segment& ray, std::vector<std::uint32_t>& stack) {
  Visits visits;
  stack.assign(1, 0);
  while (!stack.empty()) {
    const Tree::Node& node = tree.nodes[stack.back()];
    stack.pop_back();
    if (!ray.meets(node.bounds)) continue;
    if (node.is_leaf()) {
      ++visits.leaves;
      visits.references += node.count;
      continue;
    }
    ++visits.inner;
    for (std::uint32_t i = 0; i < node.count; ++i) stack.push_back(node.first + i);
  }
  visits.leaves_squared = visits.leaves * visits.leaves;
  return visits;
}

}  // namespace

RayCost ray_cost(const Tree& tree, std::span<const Segment> rays, const SahConstants& constants) {
  RayCost result;
  result.rays = rays.size();
  if (tree.empty() || rays.empty()) return result;
  const Visits visits = tbb::parallel_reduce(
      tbb::blocked_range<std::size_t>(0, rays.size(), 256), Visits{},
      [&](const tbb::blocked_range<std::size_t>& range, Visits sum) {
        std::vector<std::uint32_t> stack;
        for (std::size_t i = range.begin(); i < range.end(); ++i) sum = sum + visits_of(tree, rays[i], stack);
        return sum;
      },
      std::plus<>());
  const auto mean = [&](std::uint64_t sum) { return static_cast<double>(sum) / static_cast<double>(rays.size()); };
  result.inner_nodes = mean(visits.inner);
  result.leaves = mean(visits.leaves);
  result.references = mean(visits.references);
  result.cost = constants.traversal * result.inner_nodes + constants.intersection * result.references;
  result.lcv = std::sqrt(std::max(0.0, mean(visits.leaves_squared) - result.leaves * result.leaves));
  return result;
}

std::vector<Segment> uniform_lines(const Box& box, std::uint32_t count, std::uint64_t seed) {
  std::vector<Segment> lines;
  if (box.empty()) return lines;
  const float radius = length(box.extent()) / 2;
  for (std::uint32_t i = 0; i < count; ++i) {
    Random random(seed, i);
    const float u = random.uniform(), v = random.uniform(), s = random.uniform(), t = random.uniform();
    const Vec3 from = uniform_sphere(u, v), to = uniform_sphere(s, t);
    Ray ray;
    ray.origin = box.center() + from * radius;
    ray.direction = (to - from) * radius;
    lines.emplace_back(ray, 1.0f);
  }
  return lines;
}

}  // namespace boxwood
