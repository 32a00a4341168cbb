#pragma once
#include <limits>

#include "boxwood/vec3.h"

namespace boxwood {

/// Axis-aligned bounding box, 24 bytes. A default box is empty: lower > upper on every axis, so growing it by a
/// point gives that point, and no ray or point is inside.
struct Box {
  Vec3 lower{std::numeric_limits<float>::infinity(), std::numeric_limits<float>::infinity(),
             std::numeric_limits<float>::infinity()};
  Vec3 upper{-std::numeric_limits<float>::infinity(), -std::numeric_limits<float>::infinity(),
             -std::numeric_limits<float>::infinity()};

  constexpr bool empty() const { return !(lower.x <= upper.x && lower.y <= upper.y && lower.z <= upper.z); }
  constexpr Vec3 center() const { return (lower + upper) * 0.5f; }
  constexpr Vec3 extent() const { return upper - lower; }
  constexpr void grow(const Vec3& point) {
    lower = min(lower, point);
    upper = max(upper, point);
  }
  constexpr void grow(const Box& other) {
    lower = min(lower, other.lower);
    upper = max(upper, other.upper);
  }
  constexpr bool contains(const Box& other) const {
    return lower.x <= other.lower.x && lower.y <= other.lower.y && lower.z <= other.lower.z &&
           upper.x >= other.upper.x && upper.y >= other.upper.y && upper.z >= other.upper.z;
  }
  friend constexpr bool operator==(const Box&, const Box&) = default;
};

constexpr Box unite(Box a, const Box& b) {
  a.grow(b);
  return a;
}

/// Common part of two boxes; empty when they do not touch.
constexpr Box intersect(const Box& a, const Box& b) { return {max(a.lower, b.lower), min(a.upper, b.upper)}; }

/// Half the surface area in squared units; 0 for an empty box. Ratios of half areas are ratios of areas.
constexpr float half_area(const Box& box) {
  if (box.empty()) return 0;
  const Vec3 e = box.extent();
  return e.x * e.y + e.y * e.z + e.z * e.x;
}

/// Index of the longest side, 0…2; on a tie the smallest axis.
constexpr int longest_axis(const Vec3& extent) {
  if (extent.x >= extent.y && extent.x >= extent.z) return 0;
  return extent.y >= extent.z ? 1 : 2;
}

}  // namespace boxwood
