#pragma once
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "boxwood/box.h"

namespace boxwood {

/// Levels below the root of an octree: what a location code of 64 bits has room for.
inline constexpr std::uint32_t octree_levels = 21;
/// Smallest cells along one side of the root.
inline constexpr float octree_units = 1u << octree_levels;

/// Planes between the cells of an octree, at equal distances per axis. Cells, builders and kernels compute a plane by
/// this one expression, so that they agree to the bit; it ascends with the number of the plane.
struct OctreeGrid {
  Vec3 lower, unit;

  /// `number`: 0 … octree_units, an integer.
  float plane(std::size_t axis, float number) const { return __builtin_fmaf(number, unit[axis], lower[axis]); }
};

/// A grid whose first and last planes enclose `bounds`; they touch it unless it is very flat along an axis, which would
/// put every primitive into both halves.
OctreeGrid octree_grid(const Box& bounds);

/// One cell, in units of the grid: its lower corner and its side. All are integers. Not initialized when declared, so
/// that a walk's stack costs nothing to make.
struct OctreeCell {
  float corner[3];
  float size;

  static constexpr OctreeCell root() { return {{0, 0, 0}, octree_units}; }

  /// Octant bits: x is bit 0, y bit 1, z bit 2; a set bit is the upper half.
  OctreeCell child(std::uint32_t octant) const {
    OctreeCell cell = *this;
    cell.size *= 0.5f;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      if (octant >> axis & 1) cell.corner[axis] += cell.size;
    }
    return cell;
  }
  Box box(const OctreeGrid& grid) const {
    Box box;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      box.lower[axis] = grid.plane(axis, corner[axis]);
      box.upper[axis] = grid.plane(axis, corner[axis] + size);
    }
    return box;
  }
};

/// Location code of a cell: 1 for the root; three bits more for each level, the octant.
using OctreeCode = std::uint64_t;
inline constexpr OctreeCode octree_root = 1;

constexpr OctreeCode octree_child(OctreeCode code, std::uint32_t octant) { return code << 3 | octant; }
constexpr std::uint32_t octree_level(OctreeCode code) {
  return static_cast<std::uint32_t>(std::bit_width(code) - 1) / 3;
}
/// Octant of `code`'s ancestor (or itself) at `level` >= 1.
constexpr std::uint32_t octree_octant(OctreeCode code, std::uint32_t level) {
  return static_cast<std::uint32_t>(code >> 3 * (octree_level(code) - level)) & 7;
}
OctreeCell octree_cell(OctreeCode code);

/// What a tree that divides space into octants tells of its nodes: the cell of each. A cell of which only one octant
/// holds anything is no node, so the cell of a child may lie several levels below that of its parent. Cells that hold
/// nothing are no nodes either. Other trees leave it empty, and so do refinements.
struct OctreeCells {
  OctreeGrid grid;
  std::vector<OctreeCode> codes;  ///< one per node

  bool empty() const { return codes.empty(); }
};

}  // namespace boxwood
