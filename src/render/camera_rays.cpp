#include "render/camera_rays.h"

#include <algorithm>

#include "boxwood/error.h"
#include "render/sample_random.h"
#include "scene/camera_axes.h"

namespace boxwood {

CameraRays::CameraRays(const Camera& camera, std::uint32_t width, std::uint32_t height, std::uint32_t samples,
                       std::uint64_t seed)
    : width_(width), height_(height), samples_(samples), seed_(seed), eye_(camera.eye) {
  const CameraAxes axes(camera, width, height);
  if (samples == 0) throw UsageError("samples per pixel must be at least 1");
  forward_ = axes.forward, right_ = axes.right, up_ = axes.up;
}

Ray CameraRays::ray(std::uint32_t x, std::uint32_t y, std::uint32_t sample) const {
  float within_x = 0.5f, within_y = 0.5f;
  if (samples_ > 1) {
    // Steps of the R2 sequence, 1 / g and 1 / g^2 for g^3 = g + 1, as fractions of 2^32; whole parts wrap away.
    Random shift = sample_random(seed_, RandomUse::camera, y * width_ + x);
    const std::uint32_t shift_x = shift.bits(), shift_y = shift.bits();
    within_x = static_cast<float>((shift_x + sample * 3242174889u) >> 8) * 0x1p-24f;
    within_y = static_cast<float>((shift_y + sample * 2447445414u) >> 8) * 0x1p-24f;
  }
  const float across = (static_cast<float>(x) + within_x) / static_cast<float>(width_) * 2 - 1;
  const float down = (static_cast<float>(y) + within_y) / static_cast<float>(height_) * 2 - 1;
  Ray ray;
  ray.origin = eye_;
  ray.direction = normalize(forward_ + right_ * across - up_ * down);
  return ray;
}

std::vector<std::uint32_t> pixels_in_tiles(std::uint32_t width, std::uint32_t height) {
  constexpr std::uint32_t tile = 8;
  std::vector<std::uint32_t> pixels;
  pixels.reserve(std::size_t{width} * height);
  for (std::uint32_t top = 0; top < height; top += tile) {
    for (std::uint32_t left = 0; left < width; left += tile) {
      for (std::uint32_t y = top; y < std::min(top + tile, height); ++y) {
        for (std::uint32_t x = left; x < std::min(left + tile, width); ++x) pixels.push_back(y * width + x);
      }
    }
  }
  return pixels;
}

std::vector<std::uint32_t> pixels_in_blocks(std::uint32_t width, std::uint32_t height, std::uint32_t block,
                                            std::uint64_t seed) {
  if (block <= 1) return pixels_in_tiles(width, height);
  const std::uint32_t columns = (width + block - 1) / block, rows = (height + block - 1) / block;
  std::vector<std::uint32_t> pixels = pixels_in_tiles(columns, rows);
  for (std::uint32_t& pixel : pixels) {
    const std::uint32_t x = pixel % columns * block, y = pixel / columns * block;
    Random random = sample_random(seed, RandomUse::block, pixel);
    const std::uint32_t across = random.below(std::min(block, width - x));
    pixel = (y + random.below(std::min(block, height - y))) * width + x + across;
  }
  return pixels;
}

}  // namespace boxwood
