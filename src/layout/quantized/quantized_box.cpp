#include "layout/quantized/quantized_box.h"

#include <algorithm>

namespace boxwood {
namespace {

/// A key near `offset`, to be corrected by whole steps.
std::uint32_t guess(float offset, float step) {
  const float key = offset / step;
  return static_cast<std::uint32_t>(std::clamp(key >= 0 ? key : 0.0f, 0.0f, 255.0f));
}

}  // namespace

QuantizedBox encode(const Box& box, const Box& frame) {
  QuantizedBox out{};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const float origin = frame.lower[axis], step = grid_step(origin, frame.upper[axis]);
    std::uint32_t lower = guess(box.lower[axis] - origin, step), upper = guess(box.upper[axis] - origin, step);
    while (lower < 255 && grid_plane(origin, step, lower + 1) <= box.lower[axis]) ++lower;
    while (lower > 0 && grid_plane(origin, step, lower) > box.lower[axis]) --lower;
    while (upper > 0 && grid_plane(origin, step, upper - 1) >= box.upper[axis]) --upper;
    while (upper < 255 && grid_plane(origin, step, upper) < box.upper[axis]) ++upper;
    out.lower[axis] = static_cast<std::uint8_t>(lower);
    out.upper[axis] = static_cast<std::uint8_t>(upper);
  }
  return out;
}

}  // namespace boxwood
