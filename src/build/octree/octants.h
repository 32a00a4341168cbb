#pragma once
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "build/build_input.h"
#include "tree/octree_cells.h"

namespace boxwood {

/// Which octants of its cell each reference of a set lies in, and how many lie in each.
struct Octants {
  std::span<const std::uint8_t> masks;  ///< bit o: the reference lies in octant o; never 0
  std::array<std::uint32_t, 8> counts{};

  std::uint64_t total() const {
    std::uint64_t sum = 0;
    for (const std::uint32_t count : counts) sum += count;
    return sum;
  }
  std::uint32_t filled() const {
    std::uint32_t octants = 0;
    for (const std::uint32_t count : counts) octants += count ? 1 : 0;
    return octants;
  }
};

/// Finds octants by the references' boxes and, when `geometry` is given, by the triangles themselves. Cells are closed:
/// what lies in a plane between two cells lies in both, and a part that lies in a cell is never missed.
class OctantFinder {
 public:
  OctantFinder(std::span<const Reference> references, const OctreeGrid& grid, const Geometry* geometry);

  /// `set`: places in `references` that lie in `cell`. Writes masks[i] for set[i]; parallel where there are many.
  Octants find(std::span<const std::uint32_t> set, const OctreeCell& cell, std::span<std::uint8_t> masks) const;

 private:
  std::uint8_t mask_of(std::uint32_t place, const std::array<Box, 8>& octants, const Vec3& middle) const;

  std::span<const Reference> references_;
  const OctreeGrid& grid_;
  const Geometry* geometry_;
};

}  // namespace boxwood
