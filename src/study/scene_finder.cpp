#include "study/scene_finder.h"

#include <fmt/format.h>

#include <algorithm>

#include "measure/fingerprint.h"
#include "options/options.h"
#include "options/suggest.h"
#include "scene/cameras.h"

namespace boxwood {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view generator_prefix = "generate:";

/// What load() should be given for an entry, or "" when there is nothing.
std::string locate(const std::string& entry, std::span<const fs::path> folders) {
  if (entry.starts_with(generator_prefix)) return entry;
  std::error_code ignored;
  if (fs::path(entry).is_absolute()) return fs::exists(entry, ignored) ? entry : "";
  for (const fs::path& folder : folders) {
    if (fs::exists(folder / entry, ignored)) return (folder / entry).string();
  }
  return "";
}

/// Mean of all triangles' centroids, in double. O(placed triangles).
Vec3 mean_centroid(const Scene& scene) {
  double sum[3] = {0, 0, 0};
  double count = 0;
  for (const Instance& instance : scene.instances) {
    const Mesh& mesh = scene.meshes[instance.mesh];
    for (std::uint32_t i = 0; i < mesh.triangles.size(); ++i) {
      if (!is_usable(mesh, i)) continue;
      for (const std::uint32_t corner : mesh.triangles[i]) {
        const Vec3 p = instance.object_to_world.point(mesh.positions[corner]);
        sum[0] += p.x, sum[1] += p.y, sum[2] += p.z;
      }
      count += 3;
    }
  }
  if (count == 0) return {};
  return {static_cast<float>(sum[0] / count), static_cast<float>(sum[1] / count), static_cast<float>(sum[2] / count)};
}

std::vector<Camera> orbit_views(const Scene& scene, const OrbitSpec& spec) {
  const double radius = spec.radius > 0 ? spec.radius : spec.diagonals * length(scene.bounds().extent());
  std::vector<Camera> cameras = radius > 0 ? orbit_path(mean_centroid(scene), static_cast<float>(radius),
                                                        static_cast<float>(spec.height), spec.frames)
                                           : orbit_path(scene.bounds(), spec.frames);
  if (spec.fov) {
    for (Camera& camera : cameras) camera.fov = static_cast<float>(*spec.fov);
  }
  return cameras;
}

Vec3 place_in(const Box& box, const Vec3& share) { return box.lower + share * box.extent(); }

std::vector<Camera> path_views(const Scene& scene, const PathSpec& spec) {
  const Box bounds = scene.bounds();
  std::vector<Camera> keys;
  for (std::size_t i = 0; i < spec.eyes.size(); ++i) {
    Camera key;
    key.eye = place_in(bounds, spec.eyes[i]);
    key.direction = normalize(place_in(bounds, spec.targets[i]) - key.eye);
    key.fov = spec.fov;
    keys.push_back(key);
  }
  return spline_path(keys, spec.frames);
}

std::vector<Camera> named_views(const Scene& scene, const std::vector<std::string>& names) {
  if (names.empty()) return {scene.cameras.front()};
  std::vector<Camera> views;
  std::vector<std::string> known;
  for (const Camera& camera : scene.cameras) known.push_back(camera.name);
  for (const std::string& name : names) {
    const auto found = std::ranges::find(scene.cameras, name, &Camera::name);
    if (found == scene.cameras.end()) {
      throw UsageError(fmt::format("{} has no camera '{}'; {}", scene.name, name, suggest(name, known)));
    }
    views.push_back(*found);
  }
  return views;
}

std::vector<Camera> views_of(const Scene& scene, const SceneSpec& spec) {
  if (spec.orbit) return orbit_views(scene, *spec.orbit);
  if (spec.path) return path_views(scene, *spec.path);
  return named_views(scene, spec.cameras);
}

/// Point lights in place of the scene's own.
void light_up(Scene& scene, const std::vector<Vec3>& places) {
  if (places.empty()) return;
  const Box bounds = scene.bounds();
  scene.lights.clear();
  for (const Vec3& place : places) scene.lights.push_back({place_in(bounds, place)});
  for (Material& material : scene.materials) material.emission = {};
}

/// `count` of them, the first included, evenly apart.
std::vector<Camera> thinned(std::vector<Camera> views, std::uint32_t count) {
  if (count == 0 || views.size() <= count) return views;
  std::vector<Camera> out;
  for (std::size_t i = 0; i < count; ++i) out.push_back(views[i * views.size() / count]);
  return out;
}

}  // namespace

StudyScene find_scene(const SceneSpec& spec, std::span<const fs::path> folders, std::uint32_t frames) {
  for (const std::string& entry : spec.find) {
    const std::string place = locate(entry, folders);
    if (place.empty()) continue;
    StudyScene out;
    out.name = spec.name;
    out.source = entry;
    out.stand_in = entry != spec.find.front();
    out.scene = load(place);
    out.hash = fingerprint(out.scene);
    light_up(out.scene, spec.lights);
    out.views = thinned(views_of(out.scene, spec), frames);
    return out;
  }
  throw Error(fmt::format("the study's scene '{}' is nowhere: tried {}; name the folder that has it with --scenes",
                          spec.name, option_text::join(spec.find, ", ")));
}

std::size_t view_count(const SceneSpec& spec, std::uint32_t frames) {
  const std::size_t all = spec.orbit  ? spec.orbit->frames
                          : spec.path ? spec.path->frames
                                      : std::max<std::size_t>(1, spec.cameras.size());
  return frames == 0 ? all : std::min<std::size_t>(all, frames);
}

}  // namespace boxwood
