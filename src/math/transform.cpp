#include "boxwood/transform.h"

#include <cmath>

#include "boxwood/error.h"

namespace boxwood {

Transform Transform::rotate(const Vec3& axis, float radians) {
  const float s = std::sin(radians), c = std::cos(radians);
  const auto image = [&](const Vec3& v) { return v * c + cross(axis, v) * s + axis * (dot(axis, v) * (1 - c)); };
  return {image({1, 0, 0}), image({0, 1, 0}), image({0, 0, 1}), {}};
}

Box Transform::box(const Box& b) const {
  if (b.empty()) return b;
  Box out;
  for (int corner = 0; corner < 8; ++corner) {
    out.grow(point({(corner & 1) ? b.upper.x : b.lower.x, (corner & 2) ? b.upper.y : b.lower.y,
                    (corner & 4) ? b.upper.z : b.lower.z}));
  }
  // Room for the rounding of this map and of rays mapped by its inverse.
  const Vec3 largest = max(max(b.lower, b.upper), max(-b.lower, -b.upper));
  const auto magnitude = [&](std::size_t axis) {
    return std::fabs(x[axis]) * largest.x + std::fabs(y[axis]) * largest.y + std::fabs(z[axis]) * largest.z +
           std::fabs(translation[axis]);
  };
  const Vec3 slack = Vec3{magnitude(0), magnitude(1), magnitude(2)} * 0x1p-18f;
  return {out.lower - slack, out.upper + slack};
}

Transform Transform::inverse() const {
  const double det = static_cast<double>(determinant());
  if (!(std::isfinite(det) && det != 0)) throw Error("a transform with determinant zero or not finite has no inverse");
  const float scale = static_cast<float>(1 / det);
  // Rows of the inverse are cross products of the columns.
  const Vec3 r0 = cross(y, z) * scale, r1 = cross(z, x) * scale, r2 = cross(x, y) * scale;
  Transform out{{r0.x, r1.x, r2.x}, {r0.y, r1.y, r2.y}, {r0.z, r1.z, r2.z}, {}};
  out.translation = -out.vector(translation);
  return out;
}

}  // namespace boxwood
