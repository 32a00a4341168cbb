#include "math/triangle_box.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace boxwood {
namespace {

using Double3 = std::array<double, 3>;

Double3 difference(const Double3& a, const Double3& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }

Double3 cross(const Double3& a, const Double3& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

double dot(const Double3& a, const Double3& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

/// Whether `axis` separates the corners from the box of half sides `half` about the origin.
bool separates(const Double3& axis, const std::array<Double3, 3>& corners, const Double3& half) {
  const double p = dot(axis, corners[0]), q = dot(axis, corners[1]), r = dot(axis, corners[2]);
  const double radius = half[0] * std::fabs(axis[0]) + half[1] * std::fabs(axis[1]) + half[2] * std::fabs(axis[2]);
  return std::min({p, q, r}) > radius || std::max({p, q, r}) < -radius;
}

}  // namespace

bool triangle_meets_box(const Vec3& a, const Vec3& b, const Vec3& c, const Box& box, float slack) {
  Double3 half;
  std::array<Double3, 3> corners;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const double lower = box.lower[axis], upper = box.upper[axis], center = (lower + upper) / 2;
    half[axis] = (upper - lower) / 2 + static_cast<double>(slack);
    corners[0][axis] = static_cast<double>(a[axis]) - center;
    corners[1][axis] = static_cast<double>(b[axis]) - center;
    corners[2][axis] = static_cast<double>(c[axis]) - center;
  }
  const std::array<Double3, 3> edges = {difference(corners[1], corners[0]), difference(corners[2], corners[1]),
                                        difference(corners[0], corners[2])};
  if (separates(cross(edges[0], edges[1]), corners, half)) return false;
  for (const Double3& edge : edges) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      Double3 side{};
      side[axis] = 1;
      if (separates(cross(side, edge), corners, half)) return false;
    }
  }
  return true;
}

}  // namespace boxwood
