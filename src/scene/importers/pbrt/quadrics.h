#pragma once
#include <span>

#include "boxwood/scene.h"

namespace boxwood::pbrt {

/// A point of a curve that turns around the z axis.
struct ProfilePoint {
  float radius, z;
};

/// Segments of a full turn, and of a half circle.
inline constexpr std::uint32_t turn_segments = 64, half_circle_segments = 32;

/// The surface that `profile` sweeps when it turns by `degrees` (clamped to 0 … 360) from the x axis towards y. Closed
/// at 360. Triangles run counter-clockwise seen from the side to the right of the profile in the (radius, z) plane.
/// Where the radius is 0 there is one triangle in place of two.
Mesh revolve(std::span<const ProfilePoint> profile, float degrees);

// The quadrics of pbrt with their parameters; their outside is counter-clockwise.
Mesh sphere(float radius, float z_min, float z_max, float degrees);
Mesh cylinder(float radius, float z_min, float z_max, float degrees);
Mesh disk(float height, float radius, float inner_radius, float degrees);
Mesh cone(float height, float radius, float degrees);
Mesh paraboloid(float radius, float z_min, float z_max, float degrees);

}  // namespace boxwood::pbrt
