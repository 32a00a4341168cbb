#include "trace/precise_triangle.h"

#include <cmath>

namespace boxwood {
namespace {

bool within_limits(const DoubleVec3& v) {
  constexpr double limit = largest_double_coordinate;
  return std::fabs(v.x) <= limit && std::fabs(v.y) <= limit && std::fabs(v.z) <= limit;
}

/// Whether p * q and r * s differ, exactly.
bool products_differ(double p, double q, double r, double s) {
  const double rs = r * s;
  return std::fma(p, q, -rs) + std::fma(-r, s, rs) != 0;
}

bool has_area(const DoubleVec3& a, const DoubleVec3& b, const DoubleVec3& c) {
  const double ux = b.x - a.x, uy = b.y - a.y, uz = b.z - a.z;
  const double vx = c.x - a.x, vy = c.y - a.y, vz = c.z - a.z;
  return products_differ(uy, vz, uz, vy) || products_differ(uz, vx, ux, vz) || products_differ(ux, vy, uy, vx);
}

}  // namespace

std::optional<PreciseTriangle> precise_triangle(std::span<const DoubleVec3> vertices, const Triangle& triangle,
                                                std::uint32_t primitive) {
  const DoubleVec3 &a = vertices[triangle[0]], &b = vertices[triangle[1]], &c = vertices[triangle[2]];
  if (!(within_limits(a) && within_limits(b) && within_limits(c)) || !has_area(a, b, c)) return {};
  return PreciseTriangle{a, b, c, primitive, no_frame};
}

}  // namespace boxwood
