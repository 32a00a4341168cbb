#pragma once
#include <cstdint>
#include <optional>
#include <span>

#include "boxwood/precise.h"

namespace boxwood {

inline constexpr std::uint32_t no_frame = 0xffffffffu;

/// A triangle in double precision, copied into leaf order; or, where `frame` says so, a frame instead. 80 bytes.
struct PreciseTriangle {
  DoubleVec3 a, b, c;
  std::uint32_t primitive = 0;
  std::uint32_t frame = no_frame;
};
static_assert(sizeof(PreciseTriangle) == 80);

/// Nothing for one that no structure holds: with coordinates beyond the limit or not finite, or without area.
std::optional<PreciseTriangle> precise_triangle(std::span<const DoubleVec3> vertices, const Triangle& triangle,
                                                std::uint32_t primitive);

}  // namespace boxwood
