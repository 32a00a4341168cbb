#include "logic/difference.h"

#include <algorithm>
#include <cmath>

namespace boxwood::viewer {

Difference difference_of(const Image& a, const Image& b, float gain) {
  Difference out;
  if (a.width != b.width || a.height != b.height) return out;
  out.image = Image(a.width, a.height);
  for (std::size_t i = 0; i < a.pixels.size(); ++i) {
    const Vec3 apart = a.pixels[i] - b.pixels[i];
    const Vec3 size{std::fabs(apart.x), std::fabs(apart.y), std::fabs(apart.z)};
    out.pixels += a.pixels[i] == b.pixels[i] ? 0 : 1;
    out.largest = std::max({out.largest, size.x, size.y, size.z});
    out.image.pixels[i] = size * gain;
  }
  return out;
}

}  // namespace boxwood::viewer
