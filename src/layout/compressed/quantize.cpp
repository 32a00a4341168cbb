#include "layout/compressed/quantize.h"

#include <algorithm>
#include <cmath>

namespace boxwood {
namespace {

/// Below this, steps would leave the range of normal floats.
constexpr int least_exponent = -100;

}  // namespace

float Grid::at(std::size_t axis, std::uint8_t q) const {
  return std::fma(static_cast<float>(q), std::ldexp(1.0f, exponent[axis]), origin[axis]);
}

Grid grid_over(const Box& box) {
  Grid grid{box.lower, {}};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    int exponent = 0;
    std::frexp((box.upper[axis] - box.lower[axis]) / 255, &exponent);  // size / 255 < 2^exponent
    exponent = std::max(exponent - 1, least_exponent);
    grid.exponent[axis] = static_cast<std::int8_t>(exponent);
    while (grid.at(axis, 255) < box.upper[axis]) ++grid.exponent[axis];
  }
  return grid;
}

std::uint8_t round_down(const Grid& grid, std::size_t axis, float value) {
  const float steps = std::ldexp(value - grid.origin[axis], -grid.exponent[axis]);
  auto q = static_cast<std::uint8_t>(std::clamp(std::floor(steps), 0.0f, 255.0f));
  while (q < 255 && grid.at(axis, static_cast<std::uint8_t>(q + 1)) <= value) ++q;
  while (q > 0 && grid.at(axis, q) > value) --q;
  return q;
}

std::uint8_t round_up(const Grid& grid, std::size_t axis, float value) {
  const float steps = std::ldexp(value - grid.origin[axis], -grid.exponent[axis]);
  auto q = static_cast<std::uint8_t>(std::clamp(std::ceil(steps), 0.0f, 255.0f));
  while (q > 0 && grid.at(axis, static_cast<std::uint8_t>(q - 1)) >= value) --q;
  while (q < 255 && grid.at(axis, q) < value) ++q;
  return q;
}

}  // namespace boxwood
