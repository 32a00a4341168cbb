#include "scene/camera_axes.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "math/sampling.h"

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

void check(const Camera& camera, std::uint32_t width, std::uint32_t height) {
  const auto refuse = [&](const char* what) { throw UsageError(fmt::format("camera '{}': {}", camera.name, what)); };
  if (!is_finite(camera.eye)) refuse("the eye is not a finite point");
  if (!is_finite(camera.direction)) refuse("the direction is not finite");
  if (unit(camera.direction) == Vec3{}) refuse("the direction is zero; give one to look along");
  if (!(camera.fov > 0 && camera.fov < 180)) refuse("fov must lie between 0 and 180 degrees");
  const std::uint64_t pixels = std::uint64_t{width} * height;
  if (pixels == 0 || pixels > 1u << 31) {
    throw UsageError(fmt::format("an image of {}x{} can not be rendered; use 1 to 2^31 pixels", width, height));
  }
}

}  // namespace

CameraAxes::CameraAxes(const Camera& camera, std::uint32_t width, std::uint32_t height) {
  check(camera, width, height);
  forward = unit(camera.direction);
  const SineCosine half_angle = sine_cosine_of_turns(static_cast<double>(camera.fov) / 720);
  const double half_side = half_angle.sine / half_angle.cosine / std::min(width, height);
  const Vec3 across = right_of(forward, camera.up);
  right = across * static_cast<float>(half_side * width);
  if (camera.mirrored) right = -right;
  up = cross(across, forward) * static_cast<float>(half_side * height);
}

}  // namespace boxwood
