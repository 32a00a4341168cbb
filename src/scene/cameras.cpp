#include "scene/cameras.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "math/sampling.h"

namespace boxwood {
namespace {

constexpr float framing_fov = 45;

struct Sphere {
  Vec3 center;
  float radius;  // above 0
};

Sphere around(const Box& bounds) {
  if (bounds.empty()) return {{0, 0, 0}, 1};
  const Vec3 center = bounds.lower * 0.5f + bounds.upper * 0.5f;
  // Flat or single points still need some distance that their coordinates can resolve.
  const float size = std::max({std::fabs(center.x), std::fabs(center.y), std::fabs(center.z)});
  return {center, std::max({length(bounds.extent()) * 0.5f, size * 1e-4f, 1e-12f})};
}

/// From where a sphere just fills the field of view, with a little room for rounding.
float framing_distance(float radius) {
  return 1.02f * radius / std::sin(framing_fov * std::numbers::pi_v<float> / 360);
}

void check_frames(std::uint32_t frames) {
  if (frames == 0) throw UsageError("a camera path needs at least one frame");
}

/// Uniform Catmull-Rom segment from b (t = 0) to c (t = 1). Catmull and Rom 1974.
Vec3 catmull_rom(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d, float t) {
  const Vec3 linear = c - a, quadratic = a * 2.0f - b * 5.0f + c * 4.0f - d, cubic = b * 3.0f - a - c * 3.0f + d;
  return b + (linear + (quadratic + cubic * t) * t) * (0.5f * t);
}

Vec3 unit_or(const Vec3& v, const Vec3& otherwise) { return length(v) > 0 ? normalize(v) : otherwise; }

/// The camera at `position` key frames from the first. Beyond the ends the end key frames repeat.
Camera on_spline(std::span<const Camera> keys, double position) {
  const auto last = static_cast<std::ptrdiff_t>(keys.size()) - 1;
  const auto segment =
      std::clamp(static_cast<std::ptrdiff_t>(position), std::ptrdiff_t{0}, std::max(last - 1, std::ptrdiff_t{0}));
  const auto t = static_cast<float>(position - static_cast<double>(segment));
  const auto key = [&](std::ptrdiff_t offset) -> const Camera& {
    return keys[static_cast<std::size_t>(std::clamp(segment + offset, std::ptrdiff_t{0}, last))];
  };
  const auto along = [&](auto value) {
    return catmull_rom(value(key(-1)), value(key(0)), value(key(1)), value(key(2)), t);
  };
  Camera camera = key(0);
  camera.eye = along([](const Camera& c) { return c.eye; });
  camera.direction =
      unit_or(along([](const Camera& c) { return normalize(c.direction); }), normalize(key(0).direction));
  camera.up = unit_or(along([](const Camera& c) { return normalize(c.up); }), normalize(key(0).up));
  camera.fov = std::clamp(along([](const Camera& c) { return Vec3{c.fov, 0, 0}; }).x, 1.0f, 179.0f);
  return camera;
}

}  // namespace

Camera frame(const Box& bounds) {
  const Sphere sphere = around(bounds);
  const Vec3 towards_eye = normalize({0.6f, 0.45f, 1.0f});
  return {"auto", sphere.center + towards_eye * framing_distance(sphere.radius), -towards_eye, {0, 1, 0}, framing_fov};
}

std::vector<Camera> orbit_path(const Vec3& center, float radius, float height, std::uint32_t frames) {
  check_frames(frames);
  if (!(radius > 0 && std::isfinite(radius) && std::isfinite(height) && is_finite(center))) {
    throw UsageError(fmt::format("an orbit needs a finite centre and height and a positive radius, not {}", radius));
  }
  std::vector<Camera> path;
  for (std::uint32_t i = 0; i < frames; ++i) {
    const SineCosine turn = sine_cosine_of_turns(static_cast<double>(i) / frames);
    const Vec3 out{radius * static_cast<float>(turn.sine), height, radius * static_cast<float>(turn.cosine)};
    path.push_back({fmt::format("orbit-{:03}", i), center + out, normalize(-out), {0, 1, 0}, framing_fov});
  }
  return path;
}

std::vector<Camera> orbit_path(const Box& bounds, std::uint32_t frames) {
  const Sphere sphere = around(bounds);
  const float distance = framing_distance(sphere.radius), height = distance / 3;
  return orbit_path(sphere.center, std::sqrt(distance * distance - height * height), height, frames);
}

std::vector<Camera> spline_path(std::span<const Camera> key_frames, std::uint32_t frames) {
  check_frames(frames);
  if (key_frames.empty()) throw UsageError("a spline path needs at least one key frame");
  std::vector<Camera> path;
  for (std::uint32_t i = 0; i < frames; ++i) {
    const double part = frames > 1 ? static_cast<double>(i) / (frames - 1) : 0;
    path.push_back(on_spline(key_frames, part * static_cast<double>(key_frames.size() - 1)));
    path.back().name = fmt::format("path-{:03}", i);
  }
  return path;
}

}  // namespace boxwood
