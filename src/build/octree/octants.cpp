#include "build/octree/octants.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <bit>

#include "math/triangle_box.h"

namespace boxwood {
namespace {

constexpr std::size_t parallel_set_size = 1 << 14;

// [axis][half]: the octants in that half.
constexpr std::uint8_t halves[3][2] = {{0x55, 0xaa}, {0x33, 0xcc}, {0x0f, 0xf0}};

float magnitude_of(const Reference& reference) {
  const Vec3 largest = max(max(reference.lower, reference.upper), max(-reference.lower, -reference.upper));
  return std::max({largest.x, largest.y, largest.z});
}

}  // namespace

OctantFinder::OctantFinder(std::span<const Reference> references, const OctreeGrid& grid, const Geometry* geometry)
    : references_(references), grid_(grid), geometry_(geometry) {}

Octants OctantFinder::find(std::span<const std::uint32_t> set, const OctreeCell& cell,
                           std::span<std::uint8_t> masks) const {
  std::array<Box, 8> octants;
  for (std::uint32_t o = 0; o < 8; ++o) octants[o] = cell.child(o).box(grid_);
  const Vec3 middle = octants[0].upper;
  const auto fill = [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) masks[i] = mask_of(set[i], octants, middle);
  };
  if (set.size() < parallel_set_size) {
    fill(0, set.size());
  } else {
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, set.size(), parallel_set_size / 4),
                      [&](const auto& range) { fill(range.begin(), range.end()); });
  }
  Octants out{masks, {}};
  for (const std::uint8_t mask : masks) {
    for (std::uint32_t bits = mask; bits != 0; bits &= bits - 1) ++out.counts[std::countr_zero(bits)];
  }
  return out;
}

std::uint8_t OctantFinder::mask_of(std::uint32_t place, const std::array<Box, 8>& octants, const Vec3& middle) const {
  const Reference& reference = references_[place];
  std::uint32_t by_box = 0xff;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    if (reference.lower[axis] > middle[axis]) by_box &= halves[axis][1];
    if (reference.upper[axis] < middle[axis]) by_box &= halves[axis][0];
  }
  Vec3 corners[3];
  if (std::has_single_bit(by_box) || !geometry_ || !geometry_->corners(reference.primitive, corners)) {
    return static_cast<std::uint8_t>(by_box);
  }
  const float slack = magnitude_of(reference) * 0x1p-21f;
  std::uint32_t exact = 0;
  for (std::uint32_t bits = by_box; bits != 0; bits &= bits - 1) {
    const int octant = std::countr_zero(bits);
    if (triangle_meets_box(corners[0], corners[1], corners[2], octants[static_cast<std::size_t>(octant)], slack)) {
      exact |= 1u << octant;
    }
  }
  return static_cast<std::uint8_t>(exact ? exact : by_box);
}

}  // namespace boxwood
