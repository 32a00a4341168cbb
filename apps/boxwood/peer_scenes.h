// The scenes on which `boxwood bench --peer` measures.
#pragma once
#include <string>
#include <vector>

#include "boxwood/scene.h"

namespace boxwood::cli {

/// What to load: a scene's short name, and a file or a generator.
struct PeerScene {
  std::string name;
  std::string source;
};

/// The well-known scenes found in `folder`, or in the folder that the environment variable BOXWOOD_SCENES names when
/// `folder` is empty, and generated ones until there are six. `quick`: two small generated ones. Throws UsageError when
/// `folder` is no folder.
std::vector<PeerScene> peer_scenes(const std::string& folder, bool quick);

/// Loads it as one mesh, looked at as a camera file NAME.cameras.json beside it or above it says.
Scene load_peer_scene(const PeerScene& scene);

}  // namespace boxwood::cli
