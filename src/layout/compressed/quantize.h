#pragma once
#include <cstdint>

#include "boxwood/box.h"
#include "layout/compressed/quantized_node.h"

namespace boxwood {

/// An 8-bit grid over a box: coordinate q of an axis is origin + q * step, rounded once. q * step is exact.
struct Grid {
  Vec3 origin, step;

  float at(std::size_t axis, std::uint8_t q) const;
};

/// Significant bits of the steps of a node's grid: powers of two have one.
template <class Node>
inline constexpr int bits_of_step = 16;
template <>
inline constexpr int bits_of_step<QuantizedNode8> = 1;

/// The finest grid with steps of up to so many significant bits, at most 16, that reaches over `box`, which is not
/// empty and within the coordinates that boxwood takes.
Grid grid_over(const Box& box, int bits_of_step);

Grid grid_of(const QuantizedNode8& node);
Grid grid_of(const QuantizedNode16& node);
void set_grid(const Grid& grid, QuantizedNode8& node);
void set_grid(const Grid& grid, QuantizedNode16& node);

/// The highest grid coordinate not above `value`, the lowest not below it. `value` lies in the grid's box.
std::uint8_t round_down(const Grid& grid, std::size_t axis, float value);
std::uint8_t round_up(const Grid& grid, std::size_t axis, float value);

}  // namespace boxwood
