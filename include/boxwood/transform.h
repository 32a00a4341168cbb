#pragma once
#include "boxwood/box.h"
#include "boxwood/vec3.h"

namespace boxwood {

/// Affine map p -> x*p.x + y*p.y + z*p.z + translation, where x, y, z are the images of the unit axes. 48 bytes.
struct Transform {
  Vec3 x{1, 0, 0}, y{0, 1, 0}, z{0, 0, 1}, translation{0, 0, 0};

  static constexpr Transform translate(const Vec3& by) { return {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}, by}; }
  static constexpr Transform scale(const Vec3& by) { return {{by.x, 0, 0}, {0, by.y, 0}, {0, 0, by.z}, {}}; }
  /// Rotation by `radians` around a unit `axis` through the origin, right handed.
  static Transform rotate(const Vec3& axis, float radians);

  constexpr Vec3 vector(const Vec3& v) const { return x * v.x + y * v.y + z * v.z; }
  constexpr Vec3 point(const Vec3& p) const { return vector(p) + translation; }
  /// Box of the eight mapped corners, slightly widened against rounding.
  Box box(const Box& b) const;
  constexpr float determinant() const { return dot(cross(x, y), z); }
  /// Inverse map. Throws Error when the map is singular (determinant zero or not finite).
  Transform inverse() const;
  friend constexpr bool operator==(const Transform&, const Transform&) = default;
};

/// First `b`, then `a`.
constexpr Transform operator*(const Transform& a, const Transform& b) {
  return {a.vector(b.x), a.vector(b.y), a.vector(b.z), a.point(b.translation)};
}

}  // namespace boxwood
