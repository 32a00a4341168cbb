#include "layout/slab/slab_planes.h"

#include <limits>
#include <vector>

namespace boxwood {

BoxSide cut_by_best_side(const Box& box, Box& region) {
  BoxSide best = 0;
  float least = std::numeric_limits<float>::infinity();
  for (BoxSide side = 0; side < 6; ++side) {
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

namespace {

template <class Real>
Real surface(const Box& box) {
  const Real x = Real(box.upper.x) - Real(box.lower.x), y = Real(box.upper.y) - Real(box.lower.y);
  const Real z = Real(box.upper.z) - Real(box.lower.z);
  return 2 * (x * y + y * z + z * x);
}

}  // namespace

SlabFit slab_fit(const Tree& tree) {
  SlabFit fit;
  if (tree.empty()) return fit;
  std::vector<Box> regions(tree.nodes.size());
  regions[0] = tree.nodes[0].bounds;
  double sum = 0;
  long double exact = 0;
  std::size_t count = 0;
  for (std::size_t i = 0; i < tree.nodes.size(); ++i) {
    const Tree::Node& node = tree.nodes[i];
    if (const double own = surface<double>(node.bounds); own > 0) {
      sum += surface<double>(regions[i]) / own;
      exact += surface<long double>(regions[i]) / surface<long double>(node.bounds);
      ++count;
    }
    for (std::uint32_t c = node.first; !node.is_leaf() && c < node.first + node.count; ++c) {
      regions[c] = regions[i];
      const BoxSide side = cut_by_best_side(tree.nodes[c].bounds, regions[c]);
      fit.idle_planes += side_of(regions[c], side) == side_of(regions[i], side) ? 1 : 0;
    }
  }
  if (count == 0) return fit;
  fit.surface_ratio = sum / static_cast<double>(count);
  fit.rounding = static_cast<double>((exact - sum) / exact);
  return fit;
}

}  // namespace boxwood
