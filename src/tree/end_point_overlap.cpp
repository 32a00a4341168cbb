#include "tree/end_point_overlap.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>
#include <tbb/parallel_reduce.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "math/random.h"
#include "tree/reference_slots.h"

namespace boxwood {
namespace {

struct Point {
  double at[3];
};

/// Convex and flat: what is left of a triangle. In exact arithmetic each side of a box adds at most one corner, nine in
/// all; there is room for what rounding may add.
class Polygon {
 public:
  explicit Polygon(const std::array<Vec3, 3>& corners) {
    for (const Vec3& corner : corners) add({{corner.x, corner.y, corner.z}});
  }
  bool empty() const { return size_ == 0; }

  Polygon clipped(const Box& box) const {
    Polygon out = *this;
    for (std::size_t axis = 0; axis < 3 && !out.empty(); ++axis) {
      out.clip(axis, 1, box.lower[axis]);
      out.clip(axis, -1, box.upper[axis]);
    }
    return out;
  }

  double area() const {
    Point sum{};
    for (std::size_t i = 1; i + 1 < size_; ++i) {
      const Point a = minus(points_[i], points_[0]), b = minus(points_[i + 1], points_[0]);
      for (std::size_t k = 0; k < 3; ++k) {
        const std::size_t u = (k + 1) % 3, v = (k + 2) % 3;
        sum.at[k] += a.at[u] * b.at[v] - a.at[v] * b.at[u];
      }
    }
    return std::sqrt(sum.at[0] * sum.at[0] + sum.at[1] * sum.at[1] + sum.at[2] * sum.at[2]) / 2;
  }

 private:
  static Point minus(const Point& a, const Point& b) {
    return {{a.at[0] - b.at[0], a.at[1] - b.at[1], a.at[2] - b.at[2]}};
  }

  /// Keeps sign * (p - plane) >= 0. Sutherland and Hodgman 1974.
  void clip(std::size_t axis, double sign, double plane) {
    const std::array<Point, most> old = points_;
    const std::size_t count = size_;
    const auto side = [&](const Point& p) { return sign * (p.at[axis] - plane); };
    size_ = 0;
    for (std::size_t i = 0; i < count; ++i) {
      const Point &a = old[i], &b = old[i + 1 < count ? i + 1 : 0];
      const double at_a = side(a), at_b = side(b);
      if (at_a >= 0) add(a);
      if ((at_a > 0 && at_b < 0) || (at_a < 0 && at_b > 0)) {
        const double t = at_a / (at_a - at_b);
        Point cut;
        for (std::size_t k = 0; k < 3; ++k) cut.at[k] = a.at[k] + t * (b.at[k] - a.at[k]);
        cut.at[axis] = plane;
        add(cut);
      }
    }
  }

  void add(const Point& point) {
    if (size_ < most) points_[size_++] = point;
  }

  static constexpr std::size_t most = 16;
  std::array<Point, most> points_{};
  std::size_t size_ = 0;
};

/// Area of one triangle in nodes that do not own it: weighed over all nodes, and as it is over inner ones.
struct Overlap {
  double weighed = 0, inner = 0;
};

class Walk {
 public:
  Walk(const Tree& tree, const SahConstants& constants) : tree_(tree), constants_(constants), slots_(tree) {}
  const ReferenceSlots& slots() const { return slots_; }

  Overlap of(std::uint32_t primitive, const Polygon& triangle) const {
    Overlap overlap;
    visit(0, primitive, triangle, overlap);
    return overlap;
  }

 private:
  void visit(std::uint32_t number, std::uint32_t primitive, const Polygon& part, Overlap& overlap) const {
    const Tree::Node& node = tree_.nodes[number];
    const Polygon inside = part.clipped(node.bounds);
    if (inside.empty()) return;
    if (!slots_.owns(number, primitive)) {
      const double area = inside.area();
      overlap.weighed += area * (node.is_leaf() ? constants_.intersection * node.count : constants_.traversal);
      if (!node.is_leaf()) overlap.inner += area;
    }
    for (std::uint32_t i = 0; i < node.count && !node.is_leaf(); ++i) visit(node.first + i, primitive, inside, overlap);
  }

  const Tree& tree_;
  const SahConstants& constants_;
  ReferenceSlots slots_;
};

/// Sums made in an order that does not depend on threads.
struct Sums {
  double weighed = 0, squared = 0, inner = 0;
  Sums operator+(const Sums& other) const {
    return {weighed + other.weighed, squared + other.squared, inner + other.inner};
  }
};

template <class Of>
Sums sum(std::size_t count, const Of& of) {
  return tbb::parallel_deterministic_reduce(
      tbb::blocked_range<std::size_t>(0, count, 256), Sums{},
      [&](const tbb::blocked_range<std::size_t>& range, Sums sums) {
        for (std::size_t i = range.begin(); i < range.end(); ++i) sums = sums + of(i);
        return sums;
      },
      std::plus<>());
}

}  // namespace

EndPointOverlap end_point_overlap(const Tree& tree, const CornersOf& corners, std::uint32_t samples,
                                  const SahConstants& constants) {
  EndPointOverlap result;
  if (tree.empty()) return result;
  const Walk walk(tree, constants);

  // Every triangle once, with the area up to and with it.
  std::vector<std::uint32_t> primitives;
  for (const ReferenceSlots::Slot& slot : walk.slots().by_primitive()) {
    if (primitives.empty() || primitives.back() != slot.primitive) primitives.push_back(slot.primitive);
  }
  std::vector<double> areas(primitives.size());
  tbb::parallel_for(std::size_t{0}, primitives.size(),
                    [&](std::size_t i) { areas[i] = Polygon(corners(primitives[i])).area(); });
  std::vector<double> up_to(areas.size());
  double total = 0;
  for (std::size_t i = 0; i < areas.size(); ++i) up_to[i] = total += areas[i];
  if (!(total > 0)) return result;

  const auto overlap_of = [&](std::size_t i) { return walk.of(primitives[i], Polygon(corners(primitives[i]))); };
  if (samples == 0 || samples >= primitives.size()) {
    const Sums sums = sum(primitives.size(), [&](std::size_t i) {
      const Overlap overlap = overlap_of(i);
      return Sums{overlap.weighed, 0, overlap.inner};
    });
    result.epo = sums.weighed / total;
    result.inner_area = sums.inner;
    return result;
  }

  // One triangle from each of `samples` equal parts of the area.
  const auto count = static_cast<double>(samples);
  const Sums sums = sum(samples, [&](std::size_t s) {
    Random random(s);
    const double at = (static_cast<double>(s) + static_cast<double>(random.uniform())) / count * total;
    const auto found = std::upper_bound(up_to.begin(), up_to.end(), at) - up_to.begin();
    const std::size_t i = std::min(static_cast<std::size_t>(found), areas.size() - 1);
    if (!(areas[i] > 0)) return Sums{};
    const Overlap overlap = overlap_of(i);
    const double per_area = overlap.weighed / areas[i];
    return Sums{per_area, per_area * per_area, overlap.inner / areas[i]};
  });
  result.epo = sums.weighed / count;
  result.inner_area = sums.inner / count * total;
  const double variance = std::max(0.0, sums.squared / count - result.epo * result.epo);
  result.standard_error = std::sqrt(variance / count);
  return result;
}

}  // namespace boxwood
