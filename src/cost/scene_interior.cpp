#include "cost/scene_interior.h"

#include <algorithm>
#include <cmath>

namespace boxwood {

SceneInterior::SceneInterior(const Box& scene) {
  if (scene.empty()) return;
  const Vec3 extent = scene.extent();
  const double diagonal = length(extent);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const double margin = 1e-6 * std::max({diagonal, std::fabs(static_cast<double>(scene.lower[axis])), 1e-20});
    scene_[axis] = {scene.lower[axis] - margin, scene.upper[axis] + margin};
  }
}

double SceneInterior::reached_volume(const Box& box) const {
  if (box.empty()) return 0;
  Ranges node;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    node[axis] = {std::clamp(static_cast<double>(box.lower[axis]), scene_[axis].low, scene_[axis].high),
                  std::clamp(static_cast<double>(box.upper[axis]), scene_[axis].low, scene_[axis].high)};
  }
  return reached_volume(node);
}

void SceneInterior::probabilities(const Node& parent, std::span<const Side> sides, std::span<float> out) const {
  const double whole = reached_volume(parent.box);
  for (std::size_t i = 0; i < sides.size(); ++i) {
    // The approximation may put a child a little above its parent.
    out[i] = whole > 0 ? static_cast<float>(std::min(1.0, reached_volume(sides[i].box) / whole)) : 1;
  }
}

}  // namespace boxwood
