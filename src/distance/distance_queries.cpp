// Walks the tree by distance. A box is skipped when it lies farther away than what was found, by more than both are
// rounded: so answers depend on the triangles only.
#include <fmt/format.h>
#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "boxwood/error.h"
#include "distance/distance_data.h"
#include "distance/point_triangle.h"
#include "distance/winding.h"
#include "math/triangle_box.h"
#include "structure/same_length.h"

namespace boxwood {
namespace {

using Data = DistanceQueries::Data;
using Node = Tree::Node;

/// Depth times siblings of a balanced tree of four are far below; deeper ones go on in a vector.
using Stack = std::vector<std::pair<double, std::uint32_t>>;

float size_of(const Vec3& p) { return std::max({std::fabs(p.x), std::fabs(p.y), std::fabs(p.z)}); }

bool is_near_anything(const Data& data, const Vec3& point) {
  return !data.tree.empty() && is_finite(point) && size_of(point) <= largest_coordinate;
}

void check_distance(const char* name, float distance) {
  if (!(distance >= 0)) throw UsageError(fmt::format("'{}' must be a distance from 0 on, not {}", name, distance));
}

/// A limit of squared distance for boxes, given one for triangles.
class Widened {
 public:
  Widened(const Data& data, const Vec3& point) : slack_((double{data.reach} + double{size_of(point)}) * 0x1p-44) {}
  double operator()(double squared) const {
    const double distance = std::sqrt(squared) * (1 + 0x1p-44) + slack_;
    return distance * distance;
  }

 private:
  double slack_;
};

/// Calls visit(triangle) for all in leaves that are no farther than `limit`, which visit may lower, near ones first.
template <class Visit>
void walk_by_distance(const Data& data, const Vec3& point, const double& limit, const Visit& visit) {
  const Tree::Nodes& nodes = data.tree.nodes;
  thread_local Stack stack;
  stack.assign(1, {squared_distance(nodes[0].bounds, point), 0u});
  while (!stack.empty()) {
    const auto [distance, number] = stack.back();
    stack.pop_back();
    if (distance > limit) continue;
    const Node& node = nodes[number];
    if (node.is_leaf()) {
      for (std::uint32_t i = 0; i < node.count; ++i) visit(data.triangles[node.first + i]);
      continue;
    }
    const auto base = static_cast<std::ptrdiff_t>(stack.size());
    for (std::uint32_t c = 0; c < node.count; ++c) {
      const double d = squared_distance(nodes[node.first + c].bounds, point);
      if (d <= limit) stack.push_back({d, node.first + c});
    }
    std::sort(stack.begin() + base, stack.end(), std::greater());
  }
}

/// A triangle that was found, before its distance is rounded.
struct Found {
  OnTriangle on;
  const PlacedTriangle* triangle = nullptr;
};

bool is_nearer(const Found& a, const Found& b) {
  if (a.on.squared_distance != b.on.squared_distance) return a.on.squared_distance < b.on.squared_distance;
  return a.triangle->name < b.triangle->name;
}

NearestPoint answer(const Found& found, const Vec3& point) {
  if (!found.triangle) return {};
  const Double3& o = found.on.offset;
  NearestPoint out;
  out.distance = static_cast<float>(std::sqrt(found.on.squared_distance));
  out.point = {static_cast<float>(point.x + o.x), static_cast<float>(point.y + o.y), static_cast<float>(point.z + o.z)};
  out.u = static_cast<float>(found.triangle->turned ? found.on.v : found.on.u);
  out.v = static_cast<float>(found.triangle->turned ? found.on.u : found.on.v);
  out.primitive = found.triangle->name.primitive;
  out.instance = found.triangle->name.instance;
  return out;
}

Found find_nearest(const Data& data, const Vec3& point, float within) {
  Found best;
  if (!is_near_anything(data, point)) return best;
  const Widened widened(data, point);
  const double most = double{within} * double{within};
  double limit = widened(most);
  walk_by_distance(data, point, limit, [&](const PlacedTriangle& triangle) {
    const Found found{nearest_on(triangle, point), &triangle};
    if (found.on.squared_distance > most || (best.triangle && !is_nearer(found, best))) return;
    best = found;
    limit = widened(found.on.squared_distance);
  });
  return best;
}

std::size_t find_several(const Data& data, const Vec3& point, float within, std::span<NearestPoint> nearest) {
  std::vector<Found> best;  // in order
  if (is_near_anything(data, point) && !nearest.empty()) {
    const Widened widened(data, point);
    const double most = double{within} * double{within};
    double limit = widened(most);
    walk_by_distance(data, point, limit, [&](const PlacedTriangle& triangle) {
      const Found found{nearest_on(triangle, point), &triangle};
      if (found.on.squared_distance > most) return;
      best.insert(std::upper_bound(best.begin(), best.end(), found, is_nearer), found);
      if (best.size() > nearest.size()) best.pop_back();
      if (best.size() == nearest.size()) limit = widened(best.back().on.squared_distance);
    });
  }
  for (std::size_t i = 0; i < nearest.size(); ++i) nearest[i] = answer(i < best.size() ? best[i] : Found{}, point);
  return best.size();
}

/// Calls visit(triangle) for all in leaves whose box, and those of all above, `enter` says yes to.
template <class Enter, class Visit>
void walk_where(const Data& data, const Enter& enter, const Visit& visit) {
  if (data.tree.empty()) return;
  std::vector<std::uint32_t> stack{0};
  while (!stack.empty()) {
    const Node& node = data.tree.nodes[stack.back()];
    stack.pop_back();
    if (!enter(node.bounds)) continue;
    for (std::uint32_t i = 0; i < node.count; ++i) {
      if (node.is_leaf()) {
        visit(data.triangles[node.first + i]);
      } else {
        stack.push_back(node.first + i);
      }
    }
  }
}

/// The way out of the scene's box that is shortest.
AxisRay shortest_way_out(const Box& bounds, const Vec3& point) {
  AxisRay best{point};
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t axis = 0; axis < 3; ++axis) {
    for (const bool descending : {false, true}) {
      const double way = descending ? double{point[axis]} - double{bounds.lower[axis]}
                                    : double{bounds.upper[axis]} - double{point[axis]};
      if (way < least) least = way, best = {point, axis, descending};
    }
  }
  return best;
}

bool is_inside(const Data& data, const Vec3& point) {
  if (!is_near_anything(data, point)) return false;
  const AxisRay ray = shortest_way_out(data.tree.nodes[0].bounds, point);
  int winding = 0;
  walk_where(
      data, [&](const Box& box) { return ray.meets(box); },
      [&](const PlacedTriangle& triangle) { winding += crossing(triangle, ray); });
  return winding != 0;
}

void check_closed(const Data& data) {
  if (const std::size_t open = data.find_open_edges()) {
    throw Error(
        fmt::format("the surface does not bound a volume: {} edge{} of it {} not run as often one way as the "
                    "other; close the holes and turn all triangles the same way",
                    open, open == 1 ? "" : "s", open == 1 ? "does" : "do"));
  }
}

float find_signed_distance(const Data& data, const Vec3& point) {
  const float distance = answer(find_nearest(data, point, std::numeric_limits<float>::infinity()), point).distance;
  return is_inside(data, point) ? -distance : distance;
}

template <class Answer>
void for_each_point(std::size_t count, const Answer& answer_of) {
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, count, 64), [&](const auto& range) {
    for (std::size_t i = range.begin(); i < range.end(); ++i) answer_of(i);
  });
}

}  // namespace

NearestPoint DistanceQueries::nearest_point(const Vec3& point, float within) const {
  check_distance("within", within);
  return answer(find_nearest(*data_, point, within), point);
}

void DistanceQueries::nearest_points(std::span<const Vec3> points, std::span<NearestPoint> nearest,
                                     float within) const {
  check_same_length(points.size(), nearest.size());
  check_distance("within", within);
  for_each_point(points.size(),
                 [&](std::size_t i) { nearest[i] = answer(find_nearest(*data_, points[i], within), points[i]); });
}

std::size_t DistanceQueries::nearest_triangles(const Vec3& point, std::span<NearestPoint> nearest, float within) const {
  check_distance("within", within);
  return find_several(*data_, point, within, nearest);
}

void DistanceQueries::nearest_triangles(std::span<const Vec3> points, std::size_t k, std::span<NearestPoint> nearest,
                                        float within) const {
  check_answers_per_query(points.size(), k, nearest.size());
  check_distance("within", within);
  for_each_point(points.size(),
                 [&](std::size_t i) { find_several(*data_, points[i], within, nearest.subspan(i * k, k)); });
}

std::vector<TriangleName> DistanceQueries::triangles_within(const Vec3& center, float radius) const {
  check_distance("radius", radius);
  std::vector<TriangleName> names;
  if (!is_near_anything(*data_, center)) return names;
  const double most = double{radius} * double{radius}, limit = Widened(*data_, center)(most);
  walk_where(
      *data_, [&](const Box& bounds) { return squared_distance(bounds, center) <= limit; },
      [&](const PlacedTriangle& triangle) {
        if (nearest_on(triangle, center).squared_distance <= most) names.push_back(triangle.name);
      });
  std::ranges::sort(names);
  return names;
}

std::vector<TriangleName> DistanceQueries::triangles_in(const Box& box) const {
  std::vector<TriangleName> names;
  if (box.empty()) return names;
  const float slack = data_->reach * 0x1p-30f;
  walk_where(
      *data_, [&](const Box& bounds) { return !intersect(bounds, box).empty(); },
      [&](const PlacedTriangle& t) {
        Box own;
        for (const Vec3& p : {t.a, t.b, t.c}) own.grow(p);
        if (!intersect(own, box).empty() && triangle_meets_box(t.a, t.b, t.c, box, slack)) names.push_back(t.name);
      });
  std::ranges::sort(names);
  return names;
}

bool DistanceQueries::closed() const { return data_->find_open_edges() == 0; }

bool DistanceQueries::inside(const Vec3& point) const {
  check_closed(*data_);
  return is_inside(*data_, point);
}

float DistanceQueries::signed_distance(const Vec3& point) const {
  check_closed(*data_);
  return find_signed_distance(*data_, point);
}

void DistanceQueries::signed_distances(std::span<const Vec3> points, std::span<float> distances) const {
  check_same_length(points.size(), distances.size());
  check_closed(*data_);
  for_each_point(points.size(), [&](std::size_t i) { distances[i] = find_signed_distance(*data_, points[i]); });
}

}  // namespace boxwood
