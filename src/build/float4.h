// Boxes of four floats: one register per corner. Plain C++ with the compilers' vector types, no intrinsics.
#pragma once
#include <bit>
#include <cstdint>
#include <limits>

#include "boxwood/box.h"
#include "build/build_input.h"

namespace boxwood {

using Float4 [[gnu::vector_size(16)]] = float;
using Int4 [[gnu::vector_size(16)]] = std::int32_t;

inline Float4 min4(Float4 a, Float4 b) { return a < b ? a : b; }
inline Float4 max4(Float4 a, Float4 b) { return a > b ? a : b; }

/// As Box, in two registers. The fourth lanes are 0 in every box, so they cost no slow arithmetic.
struct Box4 {
  static constexpr float infinity = std::numeric_limits<float>::infinity();
  Float4 lower{infinity, infinity, infinity, 0};
  Float4 upper{-infinity, -infinity, -infinity, 0};

  void grow(const Box4& other) {
    lower = min4(lower, other.lower);
    upper = max4(upper, other.upper);
  }
  void grow(Float4 point) {
    lower = min4(lower, point);
    upper = max4(upper, point);
  }
  Box box() const { return {{lower[0], lower[1], lower[2]}, {upper[0], upper[1], upper[2]}}; }
};

inline Box4 box4(const Reference& reference) {
  Box4 box = std::bit_cast<Box4>(reference);
  constexpr Int4 keep{-1, -1, -1, 0};  // the fourth lane holds the primitive number
  box.lower = std::bit_cast<Float4>(std::bit_cast<Int4>(box.lower) & keep);
  return box;
}

/// Bit for bit what half_area(Box) gives; of an empty box anything.
inline float half_area(const Box4& box) {
  const Float4 e = box.upper - box.lower;
  return e[0] * e[1] + e[1] * e[2] + e[2] * e[0];
}

inline int longest_axis(const Box4& box) {
  const Float4 e = box.upper - box.lower;
  return longest_axis(Vec3{e[0], e[1], e[2]});
}

}  // namespace boxwood
