// From a path or a generator's name to a scene that can be built and looked at.
#include <fmt/format.h>

#include "boxwood/scene.h"
#include "scene/cameras.h"
#include "scene/generators.h"
#include "scene/importers/importer.h"
#include "scene/mesh_cache.h"
#include "scene/placement.h"
#include "scene/texture_file.h"

namespace boxwood {
namespace {

namespace fs = std::filesystem;

std::uintmax_t total_size(std::span<const fs::path> files) {
  std::uintmax_t total = 0;
  for (const fs::path& file : files) {
    std::error_code error;
    const std::uintmax_t size = fs::file_size(file, error);
    if (!error) total += size;
  }
  return total;
}

/// Meshes, merged and counted, without cameras other than the file's.
Scene import_and_merge(const fs::path& file) {
  if (std::optional<Scene> earlier = read_cached(file)) return std::move(*earlier);
  Imported imported = import_file(file);
  if (const std::string problem = find_bad_index(imported.scene); !problem.empty()) {
    throw Error(fmt::format("{}: {}; the file is damaged, get it again", file.string(), problem));
  }
  Scene scene = merge_single_placements(std::move(imported.scene));
  scene.name = file.stem().string();
  count_unusable(scene);
  if (scene.empty()) {
    scene.notes.messages.push_back(fmt::format("{}: has no triangles; nothing in it can be hit", file.string()));
  }
  if (total_size(imported.files) >= smallest_cached_file) write_cached(scene, imported.files);
  return scene;
}

Scene load_file(const fs::path& file) {
  Scene scene = import_and_merge(file);
  read_textures(scene);
  const fs::path sidecar = camera_sidecar(file);
  std::error_code ignored;
  if (fs::is_regular_file(sidecar, ignored)) {
    const std::vector<Camera> cameras = read_cameras(sidecar);
    scene.cameras.insert(scene.cameras.begin(), cameras.begin(), cameras.end());
  }
  return scene;
}

Scene load_generated(std::string_view call) {
  Scene scene = merge_single_placements(generate(call));
  count_unusable(scene);
  return scene;
}

}  // namespace

Scene load(std::string_view path_or_generator) {
  constexpr std::string_view generator = "generate:";
  Scene scene = path_or_generator.starts_with(generator) ? load_generated(path_or_generator.substr(generator.size()))
                                                         : load_file(fs::path(path_or_generator));
  scene.cameras.push_back(frame(scene.bounds()));
  return scene;
}

}  // namespace boxwood
