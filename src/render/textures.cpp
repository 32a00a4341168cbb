#include "render/textures.h"

#include <cmath>

namespace boxwood {
namespace {

/// Light of an sRGB byte (IEC 61966-2-1).
double linear(std::uint8_t byte) {
  static const std::array<double, 256> table = [] {
    std::array<double, 256> light{};
    for (std::size_t i = 0; i < 256; ++i) {
      const double encoded = static_cast<double>(i) / 255;
      light[i] = encoded <= 0.04045 ? encoded / 12.92 : std::pow((encoded + 0.055) / 1.055, 2.4);
    }
    return light;
  }();
  return table[byte];
}

/// The two pixels around a coordinate, and how far it is from the first to the second.
struct Between {
  std::size_t first, second;
  double share;
};

Between between(double coordinate, std::uint32_t pixels) {
  const double turned = coordinate - std::floor(coordinate);
  const double at = turned * pixels - 0.5, below = std::floor(at);
  const auto wrapped = [&](double pixel) { return static_cast<std::size_t>(pixel + pixels) % pixels; };
  return {wrapped(below), wrapped(below + 1), at - below};
}

}  // namespace

Vec3 texture_color(const Texture& texture, double u, double v) {
  if (!std::isfinite(u) || !std::isfinite(v)) return {1, 1, 1};
  const Between x = between(u, texture.width), y = between(1 - v, texture.height);
  Vec3 color;
  for (std::size_t channel = 0; channel < 3; ++channel) {
    const auto at = [&](std::size_t px, std::size_t py) {
      return linear(texture.pixels[3 * (py * texture.width + px) + channel]);
    };
    const double upper = at(x.first, y.first) * (1 - x.share) + at(x.second, y.first) * x.share;
    const double lower = at(x.first, y.second) * (1 - x.share) + at(x.second, y.second) * x.share;
    color[channel] = static_cast<float>(upper * (1 - y.share) + lower * y.share);
  }
  return color;
}

}  // namespace boxwood
