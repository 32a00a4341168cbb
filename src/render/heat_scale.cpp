#include "render/heat_scale.h"

#include <algorithm>
#include <vector>

namespace boxwood {
namespace {

// The brightest pixel in a hundred may burn out; else a few extreme rays leave everything else dark.
constexpr double share_shown = 0.99;

}  // namespace

float usual_maximum(const Image& counts) {
  std::vector<float> values;
  for (const Vec3& pixel : counts.pixels) values.push_back(std::max(pixel.x, pixel.y));
  if (values.empty()) return 0;
  const auto rank = static_cast<std::ptrdiff_t>(share_shown * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), values.begin() + rank, values.end());
  return values[static_cast<std::size_t>(rank)];
}

Image scaled(Image counts, float scale) {
  if (scale > 0) {
    for (Vec3& pixel : counts.pixels) pixel = pixel / scale;
  }
  return counts;
}

}  // namespace boxwood
