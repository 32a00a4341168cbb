// The readers of our own for scenes and what lies beside them.
#include <algorithm>
#include <iterator>
#include <optional>

#include "boxwood/scene.h"
#include "boxwood/structure.h"
#include "fuzz/support.h"
#include "scene/cameras.h"
#include "scene/importers/importer.h"
#include "scene/mesh_cache.h"
#include "scene/placement.h"

namespace boxwood::fuzz {
namespace {

constexpr std::size_t small_scene = 500;  // triangles and instances that are built and traced for every input

/// What loads can be built and traced.
void use_scene(const Scene& scene) {
  require(find_bad_index(scene).empty(), "a scene with indices out of range");
  std::size_t triangles = 0;
  for (const Mesh& mesh : scene.meshes) triangles += mesh.triangles.size();
  if (triangles > small_scene || scene.instances.size() > small_scene) return;
  const Structure structure = build(scene, "median > binary", {.threads = 1});
  for (const Camera& camera : scene.cameras) {
    const Hit hit = structure.closest_hit({.origin = camera.eye, .direction = camera.direction});
    require(!hit.valid() || hit.instance < scene.instances.size(), "a hit of an instance that is not there");
  }
}

void load_as(const char* name, Bytes bytes) {
  accept_or_refuse([&] { use_scene(load(write_file(name, bytes).string())); });
}

}  // namespace

void read_ply_file(Bytes bytes) { load_as("input.ply", bytes); }
void read_obj_file(Bytes bytes) { load_as("input.obj", bytes); }
void read_stl_file(Bytes bytes) { load_as("input.stl", bytes); }
void read_pbrt_file(Bytes bytes) { load_as("input.pbrt", bytes); }
void read_mtl_file(Bytes bytes) {
  accept_or_refuse([&] {
    Scene scene;
    read_mtl(write_file("input.mtl", bytes), scene);
  });
}
void read_camera_sidecar(Bytes bytes) {
  accept_or_refuse([&] {
    const std::vector<Camera> cameras = read_cameras(write_file("input.cameras.json", bytes));
    write_cameras(scratch() / "again.cameras.json", cameras);
    require(read_cameras(scratch() / "again.cameras.json").size() == cameras.size(), "cameras that do not read back");
  });
}

void read_cache_entry(Bytes bytes) {
  // The head of an entry names a file, its size and its time: all that the entries of two scenes share, whose first
  // field differs.
  static const std::filesystem::path source = write_file("cached.ply", {});
  static const std::string head = [] {
    std::string entries[2];
    for (const bool named : {false, true}) {
      Scene scene;
      if (named) scene.name = "x";
      write_cached(scene, std::span(&source, 1));
      std::ifstream in(cache_entry(source), std::ios::binary);
      entries[named] = {std::istreambuf_iterator<char>(in), {}};
    }
    return std::string(entries[0].begin(), std::ranges::mismatch(entries[0], entries[1]).in1);
  }();
  const std::string entry = head + text_of(bytes);
  std::ofstream(cache_entry(source), std::ios::binary).write(entry.data(), static_cast<std::streamsize>(entry.size()));
  if (const std::optional<Scene> scene = read_cached(source)) use_scene(*scene);
}

}  // namespace boxwood::fuzz
