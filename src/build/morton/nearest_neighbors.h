#pragma once
#include <bit>
#include <cstddef>
#include <cstdint>

namespace boxwood {

/// Furthest along the curve that a cluster looks for its partner.
inline constexpr std::uint32_t max_radius = 31;
/// Floats that may be read beyond the last cluster: the radius and one vector of the widest instruction set.
inline constexpr std::size_t neighbor_padding = max_radius + 1 + 16;

/// What a cluster thinks of the best pair it could form: the half area of the common box, its low bits replaced by the
/// pair's distance along the curve and by one bit of the place of the pair's lower cluster. Two pairs that share a
/// cluster never have equal keys, so the smallest key of all is the choice of both its clusters: some pair always
/// merges.
using PairKey = std::int32_t;
inline constexpr PairKey pair_code_mask = 63;

/// Bit of `lower` that tells the pair (lower, lower + distance) from (lower - distance, lower).
constexpr std::uint32_t side_bit(std::uint32_t lower, std::uint32_t distance) {
  return (lower >> std::countr_zero(distance)) & 1;
}

/// The partner that `key`, the choice of `cluster`, speaks of.
constexpr std::uint32_t partner_of(std::uint32_t cluster, PairKey key) {
  const auto code = static_cast<std::uint32_t>(key & pair_code_mask);
  const std::uint32_t distance = code >> 1;
  return side_bit(cluster, distance) == (code & 1) ? cluster + distance : cluster - distance;
}

/// Boxes of clusters as six arrays: lower x, y, z, upper x, y, z.
struct ClusterBoxes {
  float* planes[6];
};

/// keys[i] = the best pair of cluster i among those at most `radius` places away, for i in [0, count). count >= 2; the
/// planes may be read, and are overwritten, up to neighbor_padding entries past `count`; `keys` has room for
/// neighbor_padding more as well; `rows` holds radius * (count + 2 * neighbor_padding) keys of scratch. O(count *
/// radius).
void find_nearest(const ClusterBoxes& boxes, std::size_t count, std::uint32_t radius, PairKey* keys, PairKey* rows);

}  // namespace boxwood
