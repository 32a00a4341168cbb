// The inner loop of clustering: for each cluster the neighbour whose union with it has the least area. One source for
// all instruction sets; no operation is fused, so all of them choose alike.
#include "build/morton/nearest_neighbors.h"

#include <algorithm>
#include <limits>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "build/morton/nearest_neighbors.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace boxwood {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using Floats = hn::ScalableTag<float>;
using Ints = hn::RebindToSigned<Floats>;
using FloatVector = hn::Vec<Floats>;
using IntVector = hn::Vec<Ints>;
using Planes = FloatVector[6];

HWY_INLINE void load(const ClusterBoxes& boxes, std::size_t i, Planes& out) {
  for (int p = 0; p < 6; ++p) out[p] = hn::LoadU(Floats(), boxes.planes[p] + i);
}

HWY_INLINE FloatVector half_area_of_union(const Planes& a, const Planes& b) {
  const auto x = hn::Sub(hn::Max(a[3], b[3]), hn::Min(a[0], b[0]));
  const auto y = hn::Sub(hn::Max(a[4], b[4]), hn::Min(a[1], b[1]));
  const auto z = hn::Sub(hn::Max(a[5], b[5]), hn::Min(a[2], b[2]));
  return hn::Add(hn::Mul(x, hn::Add(y, z)), hn::Mul(y, z));
}

/// side_bit() of consecutive clusters, in the lowest bit.
HWY_INLINE IntVector side_bits(IntVector clusters, std::uint32_t distance) {
  const IntVector bit = hn::Set(Ints(), static_cast<std::int32_t>(distance & (~distance + 1)));
  return hn::IfThenElseZero(hn::TestBit(clusters, bit), hn::Set(Ints(), 1));
}

void FindNearest(const ClusterBoxes& boxes, std::size_t count, std::uint32_t radius, PairKey* keys, PairKey* rows) {
  const Ints ints;
  const std::size_t lanes = hn::Lanes(ints);
  const std::size_t stride = count + 2 * neighbor_padding;
  const IntVector never = hn::Set(ints, std::numeric_limits<PairKey>::max());
  // Row d holds the keys of the pairs (i, i + d); before its first entry lie pairs that do not exist.
  const auto row = [&](std::uint32_t distance) { return rows + (distance - 1) * stride + neighbor_padding; };
  for (std::uint32_t d = 1; d <= radius; ++d) {
    for (std::size_t i = 0; i < neighbor_padding; i += lanes) hn::StoreU(never, ints, row(d) - neighbor_padding + i);
  }
  for (std::size_t i = 0; i < count; i += lanes) {
    Planes own;
    load(boxes, i, own);
    const IntVector clusters = hn::Iota(ints, static_cast<std::int32_t>(i));
    IntVector best = never;
    for (std::uint32_t d = 1; d <= radius; ++d) {
      Planes other;
      load(boxes, i + d, other);
      const IntVector area =
          hn::AndNot(hn::Set(ints, pair_code_mask), hn::BitCast(ints, half_area_of_union(own, other)));
      const IntVector code = hn::Add(side_bits(clusters, d), hn::Set(ints, static_cast<std::int32_t>(d << 1)));
      const IntVector key = hn::Or(area, code);
      hn::StoreU(key, ints, row(d) + i);
      best = hn::Min(best, key);
    }
    for (std::uint32_t d = 1; d <= radius; ++d) best = hn::Min(best, hn::LoadU(ints, row(d) + i - d));
    hn::StoreU(best, ints, keys + i);
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace boxwood
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace boxwood {

HWY_EXPORT(FindNearest);

void find_nearest(const ClusterBoxes& boxes, std::size_t count, std::uint32_t radius, PairKey* keys, PairKey* rows) {
  // Beyond the last cluster lie boxes so large that nobody chooses them.
  constexpr float huge = 1e18f;
  for (int p = 0; p < 6; ++p) std::fill_n(boxes.planes[p] + count, neighbor_padding, p < 3 ? -huge : huge);
  HWY_DYNAMIC_DISPATCH(FindNearest)(boxes, count, radius, keys, rows);
}

}  // namespace boxwood
#endif
