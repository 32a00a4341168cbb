// How well one plane per node would stand for the boxes of the trees, whatever their layout: spec 003, C10, C11, C15,
// C16.
#include <algorithm>
#include <cmath>

#include "layout/slab/slab_planes.h"
#include "measure/probes/probes.h"

namespace boxwood {
namespace {

/// Of the sides of a node's children, how many lie in a side of its own box.
std::size_t shared_sides(const Tree& tree, const Tree::Node& node) {
  std::size_t count = 0;
  for (std::uint32_t c = node.first; c < node.first + node.count; ++c) {
    for (BoxSide side = 0; side < 6; ++side) {
      count += side_of(tree.nodes[c].bounds, side) == side_of(node.bounds, side) ? 1 : 0;
    }
  }
  return count;
}

std::vector<Value> measure_slabs(const ProbeInput& input) {
  double ratio = 0, weight = 0, rounding = 0, idle = 0, least_shared = 12;
  for (const Tree& tree : input.trees()) {
    const SlabFit fit = slab_fit(tree);
    const auto nodes = static_cast<double>(tree.nodes.size());
    ratio += nodes * fit.surface_ratio;
    weight += nodes;
    rounding = std::max(rounding, std::fabs(fit.rounding));
    idle += static_cast<double>(fit.idle_planes);
    for (const Tree::Node& node : tree.nodes) {
      if (node.is_leaf() || node.count != 2) continue;
      least_shared = std::min(least_shared, static_cast<double>(shared_sides(tree, node)));
    }
  }
  if (weight == 0) return {};
  return {{"surface_ratio", ratio / weight},
          {"surface_rounding", rounding},
          {"idle_planes", idle},
          {"shared_sides", least_shared}};
}

}  // namespace

Probe slabs_probe() {
  return {
      "slabs",
      ProbeScope::structure,
      false,
      "how well one plane per node stands for the boxes",
      {{"surface_ratio", "", "surface of the region that single slabs guarantee over that of the box, mean of nodes"},
       {"surface_rounding", "", "relative difference of surface_ratio to one computed in extended precision"},
       {"idle_planes", "planes", "slabs, the root's aside, that cut nothing from their region"},
       {"shared_sides", "sides", "of the twelve sides of two children, how many lie in their parent's: the least"}},
      measure_slabs};
}

}  // namespace boxwood
