#pragma once
#include <cstdint>
#include <limits>

#include "boxwood/vec3.h"

namespace boxwood {

/// A segment origin + t * direction, t in [t_near, t_far]. 32 bytes.
/// `direction` need not be of unit length; t counts in its units. Its largest component must lie in [1e-12, 1e12] and
/// origin coordinates in [-1e12, 1e12]; a ray outside these limits (NaN, infinite and zero directions included), or
/// with t_near > t_far, hits nothing.
struct Ray {
  Vec3 origin;
  float t_near = 0;
  Vec3 direction;
  float t_far = std::numeric_limits<float>::infinity();
};
static_assert(sizeof(Ray) == 32);

inline constexpr std::uint32_t no_primitive = 0xffffffffu;

/// Of a ray and of an instance: all 32 bits of its mask. A ray passes through instances whose mask has no bit in common
/// with its own.
inline constexpr std::uint32_t every_bit = 0xffffffffu;

/// Closest hit of a ray. Among hits at the same t the smallest (instance, primitive) wins, in every structure.
struct Hit {
  float t = std::numeric_limits<float>::infinity();  ///< distance in units of the direction; infinite on a miss
  float u = 0, v = 0;                                ///< barycentric weights of the triangle's second and third vertex
  std::uint32_t primitive = no_primitive;            ///< triangle number within its mesh; no_primitive on a miss
  std::uint32_t instance = no_primitive;  ///< index into Scene::instances, or as place() counts; no_primitive on a miss

  constexpr bool valid() const { return primitive != no_primitive; }
  friend constexpr bool operator==(const Hit&, const Hit&) = default;
};
static_assert(sizeof(Hit) == 20);

}  // namespace boxwood
