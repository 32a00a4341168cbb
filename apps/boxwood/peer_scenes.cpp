#include "peer_scenes.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>

#include "boxwood/error.h"
#include "scene/cameras.h"
#include "workspace.h"

namespace boxwood::cli {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t least_scenes = 6;
constexpr std::string_view generated = "generate:";

/// Files under a scenes folder, in the layout in which their archives unpack.
constexpr std::pair<const char*, const char*> known_files[] = {
    {"bunny", "bunny/bun_zipper.ply"},
    {"dragon", "dragon.ply"},
    {"crytek-sponza", "crytek-sponza/sponza.obj"},
    {"conference", "conference/conference.obj"},
    {"sanmiguel", "pbrt-sanmiguel/sanmiguel.pbrt"},
};
constexpr std::pair<const char*, const char*> generated_scenes[] = {
    {"lawn", "generate:lawn(blades=300000)"},
    {"terrain", "generate:terrain(size=500)"},
    {"stadium", "generate:stadium"},
    {"city", "generate:city"},
    {"knot", "generate:knot"},
    {"random", "generate:random(300000,size=0.02)"},
};

bool can_load(const PeerScene& scene) {
  try {
    load(scene.source);
    return true;
  } catch (const std::exception&) {
    return false;  // a format that this build does not read
  }
}

}  // namespace

std::vector<PeerScene> peer_scenes(const std::string& folder, bool quick) {
  if (quick) return {{"terrain", "generate:terrain(size=60)"}, {"sphereflake", "generate:sphereflake"}};
  const char* const variable = std::getenv("BOXWOOD_SCENES");
  const fs::path root = !folder.empty() ? fs::path(folder) : fs::path(variable ? variable : "");
  if (!root.empty() && !fs::is_directory(root)) {
    throw UsageError(
        fmt::format("'{}' is no folder; name the one that holds bunny/, dragon.ply and the other scenes, "
                    "or none to measure on generated scenes",
                    root.string()));
  }
  std::vector<PeerScene> out;
  for (const auto& [name, file] : known_files) {
    const PeerScene scene{name, (root / file).string()};
    if (!root.empty() && fs::is_regular_file(scene.source) && can_load(scene)) out.push_back(scene);
  }
  for (const auto& [name, source] : generated_scenes) {
    if (out.size() < least_scenes || std::string_view(name) == "lawn") out.push_back({name, source});
  }
  return out;
}

Scene load_peer_scene(const PeerScene& scene) {
  Scene out = flatten(load_scene(scene.source));
  out.name = scene.name;
  if (scene.source.starts_with(generated)) return out;
  const fs::path file = scene.source;
  for (const fs::path& place : {file.parent_path(), file.parent_path().parent_path()}) {
    const fs::path cameras = place / (scene.name + ".cameras.json");
    if (!fs::is_regular_file(cameras)) continue;
    const std::vector<Camera> read = read_cameras(cameras);
    out.cameras.insert(out.cameras.begin(), read.begin(), read.end());
    break;
  }
  return out;
}

}  // namespace boxwood::cli
