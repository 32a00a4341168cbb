#include "render/camera_rays.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "math/sampling.h"
#include "render/sample_random.h"

namespace boxwood {
namespace {

/// Unit vector, whatever the length of `v`; zero when `v` is zero.
Vec3 unit(const Vec3& v) {
  const float largest = std::max({std::fabs(v.x), std::fabs(v.y), std::fabs(v.z)});
  if (!(largest > 0)) return {};
  return normalize(Vec3{v.x / largest, v.y / largest, v.z / largest});
}

/// Unit vector to the right of a viewer who looks along the unit vector `forward`.
Vec3 right_of(const Vec3& forward, const Vec3& up) {
  constexpr float parallel = 1e-4f;  // sine of the angle below which the cross product is mostly rounding
  if (is_finite(up)) {
    const Vec3 right = cross(forward, unit(up));
    if (length(right) > parallel) return normalize(right);
  }
  const Vec3 size{std::fabs(forward.x), std::fabs(forward.y), std::fabs(forward.z)};
  Vec3 axis{1, 0, 0};
  if (size.y <= size.x && size.y <= size.z) {
    axis = {0, 1, 0};
  } else if (size.z <= size.x) {
    axis = {0, 0, 1};
  }
  return normalize(cross(forward, axis));
}

void check(const Camera& camera, std::uint32_t width, std::uint32_t height, std::uint32_t samples) {
  const auto refuse = [&](const char* what) { throw UsageError(fmt::format("camera '{}': {}", camera.name, what)); };
  if (!is_finite(camera.eye)) refuse("the eye is not a finite point");
  if (!is_finite(camera.direction)) refuse("the direction is not finite");
  if (unit(camera.direction) == Vec3{}) refuse("the direction is zero; give one to look along");
  if (!(camera.fov > 0 && camera.fov < 180)) refuse("fov must lie between 0 and 180 degrees");
  const std::uint64_t pixels = std::uint64_t{width} * height;
  if (pixels == 0 || pixels > 1u << 31) {
    throw UsageError(fmt::format("an image of {}x{} can not be rendered; use 1 to 2^31 pixels", width, height));
  }
  if (samples == 0) throw UsageError("samples per pixel must be at least 1");
}

}  // namespace

CameraRays::CameraRays(const Camera& camera, std::uint32_t width, std::uint32_t height, std::uint32_t samples,
                       std::uint64_t seed)
    : width_(width), height_(height), samples_(samples), seed_(seed), eye_(camera.eye) {
  check(camera, width, height, samples);
  forward_ = unit(camera.direction);
  const SineCosine half_angle = sine_cosine_of_turns(static_cast<double>(camera.fov) / 720);
  const double half_side = half_angle.sine / half_angle.cosine / std::min(width, height);
  const Vec3 right = right_of(forward_, camera.up);
  right_ = right * static_cast<float>(half_side * width);
  if (camera.mirrored) right_ = -right_;
  up_ = cross(right, forward_) * static_cast<float>(half_side * height);
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

}  // namespace boxwood
