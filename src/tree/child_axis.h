#pragma once
#include <cstdint>

#include "boxwood/box.h"

namespace boxwood {

/// The axis along which two siblings lie furthest apart, by their centres, and whether the first lies above the second.
struct ChildAxis {
  std::uint32_t axis = 0;
  bool descending = false;
};

constexpr ChildAxis child_axis(const Box& first, const Box& second) {
  const Vec3 apart = (second.lower + second.upper) - (first.lower + first.upper);
  const int axis = longest_axis(max(apart, -apart));
  return {static_cast<std::uint32_t>(axis), apart[static_cast<std::size_t>(axis)] < 0};
}

}  // namespace boxwood
