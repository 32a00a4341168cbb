#pragma once
#include <cstddef>
#include <cstdint>

namespace boxwood {

/// Furthest along the curve that a cluster looks for its partner.
inline constexpr std::uint32_t max_radius = 31;
/// Words that may be read or overwritten past the last cluster: the radius and one vector of the widest instruction
/// set.
inline constexpr std::size_t cluster_padding = max_radius + 1 + 16;

/// What is known of each cluster, one array per thing, so that eight clusters are treated at once.
struct ClusterPlanes {
  static constexpr std::size_t box_planes = 6, fact_planes = 4;
  float* boxes[box_planes];           ///< lower x, y, z, upper x, y, z
  std::uint32_t* facts[fact_planes];  ///< carried along unseen
};

/// Scratch of one round for up to `capacity` clusters; a multiple of the padding is added by the owner.
struct PairScratch {
  std::int32_t* keys;      ///< count + padding
  std::int32_t* rows;      ///< radius * (count + 2 * padding)
  std::int32_t* partners;  ///< count + padding
};

/// Pairs that join, the lower cluster ascending.
struct PairLists {
  std::int32_t *lower, *upper;  ///< count + padding
};

/// Finds for each of the `count` >= 2 clusters the one, at most `radius` places away, whose union with it has the least
/// area, and lists the pairs that choose each other; at least one does. partners[i] is the partner, or i itself. The
/// boxes are overwritten past `count`. Returns the number of pairs. O(count * radius); no operation is fused, so every
/// instruction set chooses alike.
std::size_t find_pairs(const ClusterPlanes& planes, std::size_t count, std::uint32_t radius, const PairScratch& scratch,
                       const PairLists& pairs);

/// Closes the gaps that the upper clusters of the pairs leave, those with partners[i] < i. Returns what remains.
std::size_t remove_joined(const ClusterPlanes& planes, std::size_t count, const std::int32_t* partners);

}  // namespace boxwood
