#include "logic/ray_walk.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "trace/brute_force.h"

namespace boxwood::viewer {
namespace {

/// In double and a little wide: what is shown must not leave out a box that a kernel enters.
bool enters(const Box& box, const Ray& ray, double limit, double& entry) {
  entry = ray.t_near;
  double exit = limit;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const double origin = ray.origin[axis], direction = ray.direction[axis];
    const double slack = 0x1p-19 * (std::fabs(origin) +
                                    std::max(std::fabs(double{box.lower[axis]}), std::fabs(double{box.upper[axis]})));
    const double low = box.lower[axis] - slack - origin, high = box.upper[axis] + slack - origin;
    if (direction == 0) {
      if (low > 0 || high < 0) return false;
      continue;
    }
    entry = std::max(entry, std::min(low / direction, high / direction));
    exit = std::min(exit, std::max(low / direction, high / direction));
  }
  return entry <= exit;
}

struct Open {
  std::uint32_t node, depth;
  double entry;
};

class Walker {
 public:
  Walker(const Tree& tree, const Mesh& mesh, const Ray& ray, ChildOrder order)
      : tree_(tree), mesh_(mesh), ray_(ray), order_(order), limit_(ray.t_far) {}

  RayWalk run() {
    if (tree_.empty()) return out_;
    test(0, 0);
    while (!stack_.empty()) {
      const Open next = stack_.back();
      stack_.pop_back();
      if (next.entry > limit_) {
        add(WalkStep::Kind::skipped, next.node, next.depth, next.entry);
        continue;
      }
      visit(next);
    }
    return out_;
  }

 private:
  void add(WalkStep::Kind kind, std::uint32_t node, std::uint32_t depth, double t, std::uint32_t primitive = 0) {
    out_.steps.push_back({kind, node, depth, tree_.nodes[node].is_leaf(), static_cast<float>(t), primitive});
  }

  void test(std::uint32_t node, std::uint32_t depth) {
    double entry = 0;
    const bool met = enters(tree_.nodes[node].bounds, ray_, limit_, entry);
    ++out_.node_tests;
    out_.node_hits += met ? 1 : 0;
    add(met ? WalkStep::Kind::entered : WalkStep::Kind::missed, node, depth, entry);
    if (met) stack_.push_back({node, depth, entry});
  }

  void visit(const Open& open) {
    const Tree::Node& node = tree_.nodes[open.node];
    if (node.is_leaf()) return visit_leaf(open);
    const std::size_t base = stack_.size();
    const bool descending = order_ == ChildOrder::axis && node.axis != Tree::mixed_axis && !node.fixed_order &&
                            std::signbit(ray_.direction[node.axis]);
    // The last to visit goes on the stack first.
    for (std::uint32_t c = 0; c < node.count; ++c) {
      test(node.first + (descending ? c : node.count - 1 - c), open.depth + 1);
    }
    if (order_ == ChildOrder::near && !node.fixed_order) {
      std::stable_sort(stack_.begin() + static_cast<std::ptrdiff_t>(base), stack_.end(),
                       [](const Open& a, const Open& b) { return a.entry > b.entry; });
    }
  }

  void visit_leaf(const Open& open) {
    const Tree::Node& node = tree_.nodes[open.node];
    ++out_.leaves;
    for (std::uint32_t i = node.first; i < node.first + node.count; ++i) {
      const std::uint32_t primitive = tree_.references[i];
      ++out_.primitive_tests;
      const Hit hit = test_triangle(primitive);
      add(hit.valid() ? WalkStep::Kind::hit : WalkStep::Kind::tested, open.node, open.depth, hit.t, primitive);
      const bool wins = hit.valid() && (hit.t != out_.hit.t ? hit.t < out_.hit.t : primitive < out_.hit.primitive);
      if (!wins) continue;
      out_.hit = hit;
      limit_ = hit.t;
    }
  }

  /// The one triangle test there is, by way of a scene of one triangle.
  Hit test_triangle(std::uint32_t primitive) const {
    Scene scene;
    const Triangle& t = mesh_.triangles[primitive];
    scene.add_mesh({mesh_.positions[t[0]], mesh_.positions[t[1]], mesh_.positions[t[2]]}, {{0, 1, 2}});
    Hit hit = BruteForce(scene).closest_hit(ray_);
    if (hit.valid()) hit.primitive = primitive;
    return hit;
  }

  const Tree& tree_;
  const Mesh& mesh_;
  const Ray ray_;
  const ChildOrder order_;
  double limit_;
  std::vector<Open> stack_;
  RayWalk out_;
};

}  // namespace

RayWalk walk_ray(const Tree& tree, const Mesh& mesh, const Ray& ray, ChildOrder order) {
  return Walker(tree, mesh, ray, order).run();
}

std::string describe(const WalkStep& step) {
  const char* what = step.leaf ? "leaf" : "node";
  switch (step.kind) {
    case WalkStep::Kind::missed:
      return fmt::format("{:>3}  {} {} missed", step.depth, what, step.node);
    case WalkStep::Kind::entered:
      return fmt::format("{:>3}  {} {} met at t = {:.4g}", step.depth, what, step.node, step.t);
    case WalkStep::Kind::skipped:
      return fmt::format("{:>3}  {} {} skipped: its t = {:.4g} lies behind the hit", step.depth, what, step.node,
                         step.t);
    case WalkStep::Kind::tested:
      return fmt::format("{:>3}  triangle {} missed", step.depth, step.primitive);
    case WalkStep::Kind::hit:
      break;
  }
  return fmt::format("{:>3}  triangle {} hit at t = {:.6g}", step.depth, step.primitive, step.t);
}

}  // namespace boxwood::viewer
