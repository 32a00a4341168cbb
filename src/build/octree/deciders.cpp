#include "build/octree/deciders.h"

namespace boxwood {
namespace {

double volume_of(const Box& box) {
  if (box.empty()) return 0;
  const Vec3 extent = box.extent();
  return static_cast<double>(extent.x) * static_cast<double>(extent.y) * static_cast<double>(extent.z);
}

}  // namespace

bool is_cluster(const OctreeSplit& split, std::span<const Reference> references, const OctreeOptions& options) {
  std::uint32_t fullest = 0;
  for (std::uint32_t o = 0; o < 8; ++o) {
    if (split.octants.counts[o] >= double{options.share} * split.count()) fullest |= 1u << o;
  }
  if (fullest == 0) return false;
  Box shared;
  for (std::size_t i = 0; i < split.set.size(); ++i) {
    if ((split.octants.masks[i] & fullest) == fullest)
      shared.grow(intersect(references[split.set[i]].box(), split.box));
  }
  return volume_of(shared) > double{options.volume} * volume_of(split.box);
}

}  // namespace boxwood
