// SAH alternatives study, section 2.7, equation 11.
#include "cost/scene_interior.h"

namespace boxwood {

double InteriorFast::reached_volume(const Ranges& node) const {
  double sum = node[0].size() * node[1].size() * node[2].size();
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const std::size_t u = (axis + 1) % 3, v = (axis + 2) % 3;
    const double width = scene()[u].size(), height = scene()[v].size();
    const double face = node[u].size() * node[v].size();
    for (const double depth : {node[axis].low - scene()[axis].low, scene()[axis].high - node[axis].high}) {
      if (depth <= 0) continue;
      const double slab_surface = 2 * (depth * width + width * height + height * depth);
      sum += depth * width * height * face / slab_surface;
    }
  }
  return sum;
}

}  // namespace boxwood
