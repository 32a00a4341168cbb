#include "layout/octree/octree_topology.h"

#include "boxwood/error.h"

namespace boxwood {

OctreeTopology::OctreeTopology(const Tree& tree) : tree_(tree) {
  if (!tree.empty() && tree.cells.empty()) {
    throw UsageError("this layout needs the cells of an octree, which the tree does not have; build it with 'octree'");
  }
}

void OctreeTopology::children(const OctreeItem& item, OctreeItem (&out)[8]) const {
  for (std::uint32_t octant = 0; octant < 8; ++octant)
    out[octant] = {OctreeItem::none, octree_child(item.code, octant)};
  const std::uint32_t level = octree_level(item.code) + 1;
  const OctreeCode code = tree_.cells.codes[item.node];
  if (code != item.code) {  // a cell of which only one octant holds anything
    out[octree_octant(code, level)].node = item.node;
    return;
  }
  const Tree::Node& node = tree_.nodes[item.node];
  for (std::uint32_t c = 0; c < node.count; ++c) {
    out[octree_octant(tree_.cells.codes[node.first + c], level)].node = node.first + c;
  }
}

void OctreeReferences::append(std::span<const std::uint32_t> leaf) {
  for (const std::uint32_t primitive : leaf) {
    if (primitive >= place_of_.size()) place_of_.resize(std::max<std::size_t>(primitive + 1, 2 * place_of_.size()));
    std::uint32_t& place = place_of_[primitive];
    if (place == 0) {
      primitives.push_back(primitive);
      place = static_cast<std::uint32_t>(primitives.size());
    }
    references.push_back(place - 1);
  }
}

}  // namespace boxwood
