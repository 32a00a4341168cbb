#pragma once
#include <cstddef>

#include "render/image.h"

namespace boxwood::viewer {

/// Where and how much two pictures of one size differ.
struct Difference {
  Image image;             ///< absolute difference per colour, times `gain`
  std::size_t pixels = 0;  ///< that differ in any bit
  float largest = 0;       ///< of any colour
};

Difference difference_of(const Image& a, const Image& b, float gain);

}  // namespace boxwood::viewer
