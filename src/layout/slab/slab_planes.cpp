#include "layout/slab/slab_planes.h"

#include <limits>
#include <vector>

namespace boxwood {

Side cut_by_best_side(const Box& box, Box& region) {
  Side best = 0;
  float least = std::numeric_limits<float>::infinity();
  for (Side side = 0; side < 6; ++side) {
    Box cut = region;
    side_of(cut, side) = side_of(box, side);
    const float surface = half_area(cut);
    if (!(surface <= least)) continue;
    least = surface;
    best = side;
  }
  side_of(region, best) = side_of(box, best);
  return best;
}

double slab_surface_ratio(const Tree& tree) {
  if (tree.empty()) return 0;
  const auto surface = [](const Box& box) {
    const Vec3 size = box.extent();
    const double x = size.x, y = size.y, z = size.z;
    return 2 * (x * y + y * z + z * x);
  };
  std::vector<Box> regions(tree.nodes.size());
  regions[0] = tree.nodes[0].bounds;
  double sum = 0;
  std::size_t count = 0;
  for (std::size_t i = 0; i < tree.nodes.size(); ++i) {
    const Tree::Node& node = tree.nodes[i];
    if (const double own = surface(node.bounds); own > 0) {
      sum += surface(regions[i]) / own;
      ++count;
    }
    for (std::uint32_t c = node.first; !node.is_leaf() && c < node.first + node.count; ++c) {
      regions[c] = regions[i];
      cut_by_best_side(tree.nodes[c].bounds, regions[c]);
    }
  }
  return count ? sum / static_cast<double>(count) : 0;
}

}  // namespace boxwood
