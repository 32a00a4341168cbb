#include "layout/compressed/quantize.h"

#include <algorithm>
#include <bit>
#include <cmath>

namespace boxwood {
namespace {

/// Below this, products with steps would leave the range of normal floats.
constexpr float least_step = 0x1p-100f;

/// The explicit bits of a float.
constexpr int mantissa_bits = 23;

}  // namespace

float Grid::at(std::size_t axis, std::uint8_t q) const {
  return std::fma(static_cast<float>(q), step[axis], origin[axis]);
}

Grid grid_over(const Box& box, int bits_of_step) {
  Grid grid{box.lower, {}};
  const std::uint32_t unit = std::uint32_t{1} << (mantissa_bits + 1 - bits_of_step);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const float least = std::max((box.upper[axis] - box.lower[axis]) / 255, least_step);
    // The bits of floats order as their values do, so the next with few bits is a sum.
    std::uint32_t bits = (std::bit_cast<std::uint32_t>(least) + unit - 1) & ~(unit - 1);
    while (grid.step[axis] = std::bit_cast<float>(bits), grid.at(axis, 255) < box.upper[axis]) bits += unit;
  }
  return grid;
}

Grid grid_of(const QuantizedNode8& node) {
  Grid grid;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    grid.origin[axis] = node.origin[axis];
    grid.step[axis] = std::bit_cast<float>(std::uint32_t{node.exponent[axis]} << mantissa_bits);
  }
  return grid;
}

Grid grid_of(const QuantizedNode16& node) {
  return {{node.origin[0], node.origin[1], node.origin[2]}, {node.step[0], node.step[1], node.step[2]}};
}

void set_grid(const Grid& grid, QuantizedNode8& node) {
  for (std::size_t axis = 0; axis < 3; ++axis) {
    node.origin[axis] = grid.origin[axis];
    node.exponent[axis] = static_cast<std::uint8_t>(std::bit_cast<std::uint32_t>(grid.step[axis]) >> mantissa_bits);
  }
}

void set_grid(const Grid& grid, QuantizedNode16& node) {
  for (std::size_t axis = 0; axis < 3; ++axis) {
    node.origin[axis] = grid.origin[axis];
    node.step[axis] = grid.step[axis];
  }
  node.origin[3] = node.step[3] = 0;
}

std::uint8_t round_down(const Grid& grid, std::size_t axis, float value) {
  const float steps = (value - grid.origin[axis]) / grid.step[axis];
  auto q = static_cast<std::uint8_t>(std::clamp(std::floor(steps), 0.0f, 255.0f));
  while (q < 255 && grid.at(axis, static_cast<std::uint8_t>(q + 1)) <= value) ++q;
  while (q > 0 && grid.at(axis, q) > value) --q;
  return q;
}

std::uint8_t round_up(const Grid& grid, std::size_t axis, float value) {
  const float steps = (value - grid.origin[axis]) / grid.step[axis];
  auto q = static_cast<std::uint8_t>(std::clamp(std::ceil(steps), 0.0f, 255.0f));
  while (q > 0 && grid.at(axis, static_cast<std::uint8_t>(q - 1)) >= value) --q;
  while (q < 255 && grid.at(axis, q) < value) ++q;
  return q;
}

}  // namespace boxwood
