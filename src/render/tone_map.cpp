#include "render/tone_map.h"

#include <cmath>

#include "render/lights.h"

namespace boxwood {
namespace {

constexpr float middle_grey = 0.18f;
constexpr float white = 4;  // exposed luminance that becomes 1

/// Factor that brings the geometric mean to middle grey; 1 for a black picture.
float automatic_factor(const Image& radiance) {
  double logarithms = 0;
  std::uint64_t count = 0;
  for (const Vec3& pixel : radiance.pixels) {
    const float bright = luminance(pixel);
    if (!(bright > 0 && std::isfinite(bright))) continue;
    logarithms += std::log(static_cast<double>(bright));
    ++count;
  }
  if (count == 0) return 1;
  return static_cast<float>(static_cast<double>(middle_grey) / std::exp(logarithms / static_cast<double>(count)));
}

}  // namespace

Image map_tones(const Image& radiance, std::optional<float> exposure) {
  const float factor = exposure ? std::exp2(*exposure) : automatic_factor(radiance);
  Image mapped = radiance;
  for (Vec3& pixel : mapped.pixels) {
    const float bright = luminance(pixel) * factor;
    pixel = pixel * (factor * (1 + bright / (white * white)) / (1 + bright));
  }
  return mapped;
}

}  // namespace boxwood
