#include "tree/octree_cells.h"

#include <algorithm>

namespace boxwood {

OctreeGrid octree_grid(const Box& bounds) {
  constexpr float least_flatness = 0x1p-12f;  // a cell's side is at least this part of its longest
  OctreeGrid grid{bounds.lower, {}};
  const Vec3 extent = bounds.extent();
  const float least = std::max({extent.x, extent.y, extent.z}) * least_flatness;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    grid.unit[axis] = std::max(extent[axis], least) / octree_units;
    while (grid.plane(axis, octree_units) < bounds.upper[axis]) {
      grid.unit[axis] = std::nextafter(grid.unit[axis], std::numeric_limits<float>::infinity());
    }
  }
  return grid;
}

OctreeCell octree_cell(OctreeCode code) {
  OctreeCell cell = OctreeCell::root();
  for (std::uint32_t level = 1; level <= octree_level(code); ++level) cell = cell.child(octree_octant(code, level));
  return cell;
}

}  // namespace boxwood
