#include "math/clip.h"

#include <array>
#include <cmath>

namespace boxwood {
namespace {

/// A convex polygon of at most 9 corners: a triangle cut by six planes.
struct Polygon {
  std::array<Vec3, 9> corners;
  int count = 0;
  void add(const Vec3& corner) { corners[static_cast<std::size_t>(count++)] = corner; }
};

/// The part where sign * (p[axis] - plane) <= 0.
Polygon cut(const Polygon& in, int axis, float plane, float sign) {
  Polygon out;
  const auto a = static_cast<std::size_t>(axis);
  for (int i = 0; i < in.count; ++i) {
    const Vec3& p = in.corners[static_cast<std::size_t>(i)];
    const Vec3& q = in.corners[static_cast<std::size_t>((i + 1) % in.count)];
    const bool p_inside = sign * (p[a] - plane) <= 0, q_inside = sign * (q[a] - plane) <= 0;
    if (p_inside) out.add(p);
    if (p_inside != q_inside) {
      Vec3 crossing = p + (q - p) * ((plane - p[a]) / (q[a] - p[a]));
      crossing[a] = plane;
      out.add(crossing);
    }
  }
  return out;
}

}  // namespace

Box clip_triangle(const Vec3& a, const Vec3& b, const Vec3& c, const Box& region) {
  Polygon polygon;
  polygon.add(a);
  polygon.add(b);
  polygon.add(c);
  Box whole;
  for (const Vec3& corner : {a, b, c}) whole.grow(corner);
  for (int axis = 0; axis < 3 && polygon.count > 0; ++axis) {
    const auto i = static_cast<std::size_t>(axis);
    if (whole.lower[i] < region.lower[i]) polygon = cut(polygon, axis, region.lower[i], -1);
    if (whole.upper[i] > region.upper[i]) polygon = cut(polygon, axis, region.upper[i], 1);
  }
  Box box;
  for (int i = 0; i < polygon.count; ++i) box.grow(polygon.corners[static_cast<std::size_t>(i)]);
  if (box.empty()) return box;
  const Vec3 magnitude = max(max(whole.lower, whole.upper), max(-whole.lower, -whole.upper));
  const Vec3 slack = magnitude * 0x1p-21f;
  return intersect(intersect({box.lower - slack, box.upper + slack}, region), whole);
}

}  // namespace boxwood
