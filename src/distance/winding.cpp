// Inside or outside by counting crossings, exact where other ways need luck: seen along the ray, a triangle winds
// around the ray's foot or it does not. An edge that passes the foot's height counts for its lower end included, upper
// end excluded; which side it passes on is an exact sign. So both triangles of an edge, and all of a vertex, agree.
#include "distance/winding.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "distance/double3.h"

namespace boxwood {
namespace {

struct Flat {
  double x, y;
};

/// Sign of ax * by - ay * bx, exact (Kahan's difference of products) where the quick form is in doubt.
int side(const Flat& a, const Flat& b) {
  const double left = a.x * b.y, right = a.y * b.x, quick = left - right;
  const double doubt = (std::fabs(left) + std::fabs(right)) * 0x1p-51;
  if (quick > doubt) return 1;
  if (quick < -doubt) return -1;
  const double error = std::fma(-a.y, b.x, right), exact = std::fma(a.x, b.y, -right) + error;
  return exact > 0 ? 1 : exact < 0 ? -1 : 0;
}

/// How often the edge ab passes to the right of the origin upwards, less downwards.
int passes(const Flat& a, const Flat& b) {
  const bool a_below = a.y <= 0, b_below = b.y <= 0;
  if (a_below == b_below) return 0;
  const int s = side(a, b);
  if (a_below) return s > 0 ? 1 : 0;
  return s < 0 ? -1 : 0;
}

struct Edge {
  Vec3 from, to;  // from comes first
  int direction;

  bool joins_as(const Edge& other) const { return from == other.from && to == other.to; }
};

bool comes_first(const Vec3& a, const Vec3& b) {
  if (a.x != b.x) return a.x < b.x;
  return a.y != b.y ? a.y < b.y : a.z < b.z;
}

Edge edge_of(const Vec3& a, const Vec3& b) { return comes_first(a, b) ? Edge{a, b, 1} : Edge{b, a, -1}; }

}  // namespace

bool AxisRay::meets(const Box& box) const {
  for (std::size_t k = 1; k < 3; ++k) {
    const std::size_t other = (axis + k) % 3;
    if (!(box.lower[other] <= origin[other] && origin[other] <= box.upper[other])) return false;
  }
  return descending ? box.lower[axis] <= origin[axis] : box.upper[axis] >= origin[axis];
}

int crossing(const PlacedTriangle& triangle, const AxisRay& ray) {
  const std::size_t x = (ray.axis + 1) % 3, y = (ray.axis + 2) % 3;
  const auto flat = [&](const Vec3& p) {
    return Flat{double{p[x]} - double{ray.origin[x]}, double{p[y]} - double{ray.origin[y]}};
  };
  const Flat a = flat(triangle.a), b = flat(triangle.b), c = flat(triangle.c);
  const int winding = passes(a, b) + passes(b, c) + passes(c, a);
  if (winding == 0) return 0;
  const Double3 from_a = difference(triangle.a, ray.origin), from_b = difference(triangle.b, ray.origin),
                from_c = difference(triangle.c, ray.origin);
  const double volume = dot(from_a, cross(from_b, from_c));
  const bool ahead = (volume * winding > 0) != ray.descending;
  return ahead ? winding : 0;
}

std::size_t open_edges(std::span<const PlacedTriangle> triangles) {
  std::vector<Edge> edges;
  edges.reserve(3 * triangles.size());
  for (const PlacedTriangle& t : triangles) {
    for (const Edge& edge : {edge_of(t.a, t.b), edge_of(t.b, t.c), edge_of(t.c, t.a)}) edges.push_back(edge);
  }
  std::sort(edges.begin(), edges.end(), [](const Edge& a, const Edge& b) {
    return a.from == b.from ? comes_first(a.to, b.to) : comes_first(a.from, b.from);
  });
  std::size_t open = 0;
  for (std::size_t begin = 0, end = 0; begin < edges.size(); begin = end) {
    int sum = 0;
    for (; end < edges.size() && edges[end].joins_as(edges[begin]); ++end) sum += edges[end].direction;
    if (sum != 0 && !(edges[begin].from == edges[begin].to)) ++open;
  }
  return open;
}

}  // namespace boxwood
