#pragma once
#include <array>
#include <cstdint>

#include "boxwood/box.h"

namespace boxwood {

/// Added to exponents of grids where nodes keep them, as floats do.
inline constexpr int exponent_bias = 127;

/// An 8-bit grid over a box: coordinate q of an axis is origin + q * 2^exponent, rounded once.
struct Grid {
  Vec3 origin;
  std::array<std::int8_t, 3> exponent;

  float at(std::size_t axis, std::uint8_t q) const;
};

/// The finest grid that reaches over `box`, which is not empty and within the coordinates that boxwood takes.
Grid grid_over(const Box& box);

/// The highest grid coordinate not above `value`, the lowest not below it. `value` lies in the grid's box.
std::uint8_t round_down(const Grid& grid, std::size_t axis, float value);
std::uint8_t round_up(const Grid& grid, std::size_t axis, float value);

}  // namespace boxwood
