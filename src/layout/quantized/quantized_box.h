#pragma once
#include <hwy/base.h>

#include <cstdint>

#include "boxwood/box.h"

namespace boxwood {

/// A box as 256 grid planes per axis of a larger one, its frame. 6 bytes: lower x, y, z, upper x, y, z. Mahovsky,
/// Wyvill 2006; spec 004, section 2.6.1, whose printed formulas let boxes shrink by rounding. These do not.
struct QuantizedBox {
  std::uint8_t lower[3], upper[3];
};
static_assert(sizeof(QuantizedBox) == 6);

/// Distance of two grid planes: a little more than 1/255 of the frame, so that the last plane is never inside it,
/// however sums are rounded. The tiny term is for frames of subnormal extent.
HWY_INLINE float grid_step(float lower, float upper) {
  constexpr float share = 1.0f / 255 * (1 + 0x1p-20f);
  return __builtin_fmaf(upper - lower, share, 0x1p-149f);
}

/// Ascends with `key`; key 0 is the frame's own lower plane.
HWY_INLINE float grid_plane(float lower, float step, std::uint32_t key) {
  return __builtin_fmaf(static_cast<float>(key), step, lower);
}

HWY_INLINE Box decode(const QuantizedBox& key, const Box& frame) {
  Box box;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const float step = grid_step(frame.lower[axis], frame.upper[axis]);
    box.lower[axis] = grid_plane(frame.lower[axis], step, key.lower[axis]);
    box.upper[axis] = grid_plane(frame.lower[axis], step, key.upper[axis]);
  }
  return box;
}

/// The smallest key whose box holds `box`, which must lie inside `frame`.
QuantizedBox encode(const Box& box, const Box& frame);

/// No ray meets it.
inline constexpr QuantizedBox absent_box{{255, 255, 255}, {0, 0, 0}};

}  // namespace boxwood
