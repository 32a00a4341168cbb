#pragma once
#include <cstdint>
#include <filesystem>
#include <span>
#include <vector>

#include "boxwood/scene.h"

namespace boxwood {

/// A camera named "auto" that sees all of `bounds`: from outside, above and to the side, at a distance where the sphere
/// around the box just fits a square image. Empty bounds give a camera at the origin's side. Y is taken as up.
Camera frame(const Box& bounds);

/// Frames, evenly spaced in angle, of a level circle of `radius` around `center`, looking at the centre; `height` is
/// the eye's height above it. Frame 0 is on the +z side, the circle turns towards +x. Named "orbit-000" and so on.
/// Throws UsageError for no frames, or a radius that is not positive and finite.
std::vector<Camera> orbit_path(const Vec3& center, float radius, float height, std::uint32_t frames);
/// An orbit that keeps all of `bounds` in view from a third of its distance above the middle.
std::vector<Camera> orbit_path(const Box& bounds, std::uint32_t frames);

/// `frames` cameras along a Catmull-Rom spline through the eyes, directions, up vectors and angles of `key_frames`, the
/// first and the last included, evenly spaced in key frame numbers. One key frame stands still. Named "path-000" and so
/// on. Throws UsageError for no key frames or no frames.
std::vector<Camera> spline_path(std::span<const Camera> key_frames, std::uint32_t frames);

/// Where the cameras of a scene file are kept: its name with .cameras.json in place of its extension or, where only
/// that exists, the name of its folder with .cameras.json, beside the folder.
std::filesystem::path camera_sidecar(const std::filesystem::path& scene_file);
/// Pixels that a camera may ask for on one side.
inline constexpr std::uint32_t largest_camera_side = 16384;
/// Reads {"cameras": [{"name", "eye", "direction", "up", "fov"}]}, each optionally with "mirrored" and "size". Throws
/// Error naming the file and the field.
std::vector<Camera> read_cameras(const std::filesystem::path& file);
/// Writes the same format; numbers read back exactly. An existing file is replaced only once the new one is complete.
void write_cameras(const std::filesystem::path& file, std::span<const Camera> cameras);

}  // namespace boxwood
