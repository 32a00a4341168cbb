#include "scene/importers/pbrt/quadrics.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "math/sampling.h"

namespace boxwood::pbrt {

Mesh revolve(std::span<const ProfilePoint> profile, float degrees) {
  const float turn = std::clamp(degrees / 360, 0.0f, 1.0f);
  const bool closed = turn == 1;
  const auto segments = std::max(1u, static_cast<std::uint32_t>(std::ceil(turn * turn_segments)));
  const std::uint32_t columns = closed ? segments : segments + 1;
  const auto rows = static_cast<std::uint32_t>(profile.size());
  Mesh mesh;
  mesh.positions.reserve(std::size_t{rows} * columns);
  for (const ProfilePoint& at : profile) {
    for (std::uint32_t column = 0; column < columns; ++column) {
      const SineCosine around = sine_cosine_of_turns(static_cast<double>(turn) * column / segments);
      mesh.positions.push_back(
          {at.radius * static_cast<float>(around.cosine), at.radius * static_cast<float>(around.sine), at.z});
    }
  }
  for (std::uint32_t row = 0; row + 1 < rows; ++row) {
    for (std::uint32_t segment = 0; segment < segments; ++segment) {
      const std::uint32_t a = row * columns + segment, b = row * columns + (segment + 1) % columns;
      const std::uint32_t c = a + columns, d = b + columns;
      if (profile[row].radius != 0) mesh.triangles.push_back({a, b, d});
      if (profile[row + 1].radius != 0) mesh.triangles.push_back({a, d, c});
    }
  }
  return mesh;
}

Mesh sphere(float radius, float z_min, float z_max, float degrees) {
  const float size = std::fabs(radius);
  const auto angle_of = [&](float z) {  // from the south pole, in turns
    return size > 0 ? 0.5f - std::acos(std::clamp(z / size, -1.0f, 1.0f)) / (2 * std::numbers::pi_v<float>) : 0;
  };
  const float first = angle_of(std::min(z_min, z_max)), last = angle_of(std::max(z_min, z_max));
  const auto rows = std::max(1u, static_cast<std::uint32_t>(std::ceil((last - first) * 2 * half_circle_segments)));
  std::vector<ProfilePoint> profile;
  for (std::uint32_t row = 0; row <= rows; ++row) {
    const float part = static_cast<float>(row) / static_cast<float>(rows);
    const SineCosine at = sine_cosine_of_turns(static_cast<double>(first * (1 - part) + last * part));
    profile.push_back({size * static_cast<float>(std::max(at.sine, 0.0)), -size * static_cast<float>(at.cosine)});
  }
  if (first == 0) profile.front().radius = 0;
  if (last == 0.5f) profile.back().radius = 0;
  return revolve(profile, degrees);
}

Mesh cylinder(float radius, float z_min, float z_max, float degrees) {
  const ProfilePoint profile[] = {{radius, std::min(z_min, z_max)}, {radius, std::max(z_min, z_max)}};
  return revolve(profile, degrees);
}

Mesh disk(float height, float radius, float inner_radius, float degrees) {
  const ProfilePoint profile[] = {{radius, height}, {inner_radius, height}};
  return revolve(profile, degrees);
}

Mesh cone(float height, float radius, float degrees) {
  const ProfilePoint profile[] = {{radius, 0}, {0, height}};
  return revolve(profile, degrees);
}

Mesh paraboloid(float radius, float z_min, float z_max, float degrees) {
  const float low = std::max(std::min(z_min, z_max), 0.0f), high = std::max(z_min, z_max);
  std::vector<ProfilePoint> profile;
  for (std::uint32_t row = 0; row <= half_circle_segments; ++row) {
    const float part = static_cast<float>(row) / half_circle_segments, z = low * (1 - part) + high * part;
    profile.push_back({high > 0 ? radius * std::sqrt(z / high) : 0, z});
  }
  return revolve(profile, degrees);
}

}  // namespace boxwood::pbrt
