#pragma once
#include <cstdint>
#include <string>
#include <vector>

namespace boxwood {

/// Real meshes that a package manager can install.
struct SceneSource {
  std::string package;    ///< "glmark2-data"
  std::string installer;  ///< what to type: "apt install glmark2-data"
  std::string path;       ///< where it puts the scene, relative to the working directory for npm
  std::string summary;
  std::uint64_t triangles;  ///< 0 for a folder of many scenes
  bool readable;            ///< whether `load` reads this format as it stands
};

const std::vector<SceneSource>& scene_sources();
bool is_installed(const SceneSource& source);

}  // namespace boxwood
