// The inner loops of clustering, one source for all instruction sets.
//
// A pair is judged by a key: the half area of the common box, its low six bits replaced by the distance along the curve
// and by one bit of the place of the lower cluster. Two pairs that share a cluster never have equal keys (same
// distance: one is the other moved by that distance, which flips the bit). So the smallest key of all is the choice of
// both its clusters and some pair always joins, and equal keys at both ends mean that they chose each other.
#include "build/morton/cluster_kernels.h"

#include <algorithm>
#include <array>
#include <limits>

#ifndef BOXWOOD_COMPACTION_TABLE
#define BOXWOOD_COMPACTION_TABLE
namespace boxwood {

/// For each set of eight lanes its members in order, then zeros. Highway's own Compress() copies its table to the stack
/// on every call when GCC 12 compiles it for AVX2, which doubled the time of clustering.
constexpr std::array<std::array<std::uint8_t, 8>, 256> members_of_sets() {
  std::array<std::array<std::uint8_t, 8>, 256> table{};
  for (unsigned set = 0; set < 256; ++set) {
    std::size_t next = 0;
    for (std::uint8_t lane = 0; lane < 8; ++lane) {
      if (set >> lane & 1) table[set][next++] = lane;
    }
  }
  return table;
}
static constexpr auto compaction_table = members_of_sets();

}  // namespace boxwood
#endif

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "build/morton/cluster_kernels.cpp"
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
using Boxes = FloatVector[ClusterPlanes::box_planes];

constexpr std::int32_t code_mask = 63;

HWY_INLINE void Load(const ClusterPlanes& planes, std::size_t i, Boxes& out) {
  for (std::size_t p = 0; p < ClusterPlanes::box_planes; ++p) out[p] = hn::LoadU(Floats(), planes.boxes[p] + i);
}

HWY_INLINE FloatVector HalfAreaOfUnion(const Boxes& a, const Boxes& b) {
  const auto x = hn::Sub(hn::Max(a[3], b[3]), hn::Min(a[0], b[0]));
  const auto y = hn::Sub(hn::Max(a[4], b[4]), hn::Min(a[1], b[1]));
  const auto z = hn::Sub(hn::Max(a[5], b[5]), hn::Min(a[2], b[2]));
  return hn::Add(hn::Mul(x, hn::Add(y, z)), hn::Mul(y, z));
}

/// The bit of the lower cluster's place that tells a pair from the pair `distance` further on: the lowest bit of the
/// distance, moved to the lowest place.
HWY_INLINE IntVector SideBit(IntVector lower, IntVector distance) {
  const IntVector bit = hn::And(distance, hn::Neg(distance));
  return hn::IfThenElseZero(hn::TestBit(lower, bit), hn::Set(Ints(), 1));
}

/// Moves the chosen lanes of any number of vectors to the front; what follows them is arbitrary.
class Compaction {
 public:
  explicit Compaction(hn::Mask<Ints> chosen) : chosen_(chosen) {
    if constexpr (hn::MaxLanes(Ints()) <= 8) {
      const hn::Rebind<std::uint8_t, Ints> bytes;
      std::uint8_t bits[8];
      hn::StoreMaskBits(Ints(), chosen, bits);
      order_ = hn::PromoteTo(Ints(), hn::LoadU(bytes, compaction_table[bits[0]].data()));
    }
  }
  IntVector operator()(IntVector v) const {
    if constexpr (hn::MaxLanes(Ints()) <= 8) {
      return hn::TableLookupLanes(v, hn::IndicesFromVec(Ints(), order_));
    } else {
      return hn::Compress(v, chosen_);
    }
  }

 private:
  hn::Mask<Ints> chosen_;
  IntVector order_ = hn::Zero(Ints());
};

void FindKeys(const ClusterPlanes& planes, std::size_t count, std::uint32_t radius, const PairScratch& scratch) {
  const Ints ints;
  const std::size_t lanes = hn::Lanes(ints);
  const std::size_t stride = count + 2 * cluster_padding;
  const IntVector never = hn::Set(ints, std::numeric_limits<std::int32_t>::max());
  // Row d holds the keys of the pairs (i, i + d); before its first entry lie pairs that do not exist.
  const auto row = [&](std::uint32_t distance) { return scratch.rows + (distance - 1) * stride + cluster_padding; };
  for (std::uint32_t d = 1; d <= radius; ++d) {
    for (std::size_t i = 0; i < cluster_padding; i += lanes) hn::StoreU(never, ints, row(d) - cluster_padding + i);
  }
  for (std::size_t i = 0; i < count; i += lanes) {
    Boxes own;
    Load(planes, i, own);
    const IntVector places = hn::Iota(ints, static_cast<std::int32_t>(i));
    IntVector best = never;
    for (std::uint32_t d = 1; d <= radius; ++d) {
      Boxes other;
      Load(planes, i + d, other);
      const IntVector distance = hn::Set(ints, static_cast<std::int32_t>(d));
      const IntVector area = hn::BitCast(ints, HalfAreaOfUnion(own, other));
      const IntVector code = hn::Add(SideBit(places, distance), hn::Add(distance, distance));
      const IntVector key = hn::Or(hn::AndNot(hn::Set(ints, code_mask), area), code);
      hn::StoreU(key, ints, row(d) + i);
      best = hn::Min(best, key);
    }
    for (std::uint32_t d = 1; d <= radius; ++d) best = hn::Min(best, hn::LoadU(ints, row(d) + i - d));
    hn::StoreU(best, ints, scratch.keys + i);
  }
}

std::size_t FindPairs(const ClusterPlanes& planes, std::size_t count, std::uint32_t radius, const PairScratch& scratch,
                      const PairLists& pairs) {
  FindKeys(planes, count, radius, scratch);
  const Ints ints;
  const IntVector end = hn::Set(ints, static_cast<std::int32_t>(count));
  std::size_t found = 0;
  for (std::size_t i = 0; i < count; i += hn::Lanes(ints)) {
    const IntVector places = hn::Iota(ints, static_cast<std::int32_t>(i));
    const auto inside = hn::Lt(places, end);
    const IntVector key = hn::LoadU(ints, scratch.keys + i);
    const IntVector distance = hn::ShiftRight<1>(hn::And(key, hn::Set(ints, code_mask)));
    const auto is_lower = hn::Eq(SideBit(places, distance), hn::And(key, hn::Set(ints, 1)));
    const IntVector chosen = hn::IfThenElse(is_lower, hn::Add(places, distance), hn::Sub(places, distance));
    const IntVector safe = hn::IfThenElseZero(inside, chosen);
    const auto agreed = hn::And(inside, hn::Eq(hn::GatherIndex(ints, scratch.keys, safe), key));
    hn::StoreU(hn::IfThenElse(agreed, chosen, places), ints, scratch.partners + i);
    const auto lower = hn::And(agreed, is_lower);
    // Whole vectors are stored: masked stores are slow on some machines, and what is too much is overwritten next.
    const Compaction compact(lower);
    hn::StoreU(compact(places), ints, pairs.lower + found);
    hn::StoreU(compact(chosen), ints, pairs.upper + found);
    found += hn::CountTrue(ints, lower);
  }
  return found;
}

std::size_t RemoveJoined(const ClusterPlanes& planes, std::size_t count, const std::int32_t* partners) {
  const Floats floats;
  const hn::RebindToUnsigned<Floats> words;
  const Ints ints;
  const IntVector end = hn::Set(ints, static_cast<std::int32_t>(count));
  std::size_t kept = 0;
  for (std::size_t i = 0; i < count; i += hn::Lanes(ints)) {
    const IntVector places = hn::Iota(ints, static_cast<std::int32_t>(i));
    const auto leaves = hn::Lt(hn::LoadU(ints, partners + i), places);
    const auto stays = hn::AndNot(leaves, hn::Lt(places, end));
    const Compaction compact(stays);
    for (float* plane : planes.boxes) {
      const IntVector moved = compact(hn::BitCast(ints, hn::LoadU(floats, plane + i)));
      hn::StoreU(hn::BitCast(floats, moved), floats, plane + kept);
    }
    for (std::uint32_t* plane : planes.facts) {
      const IntVector moved = compact(hn::BitCast(ints, hn::LoadU(words, plane + i)));
      hn::StoreU(hn::BitCast(words, moved), words, plane + kept);
    }
    kept += hn::CountTrue(ints, stays);
  }
  return kept;
}

}  // namespace HWY_NAMESPACE
}  // namespace boxwood
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace boxwood {

HWY_EXPORT(FindPairs);
HWY_EXPORT(RemoveJoined);

std::size_t find_pairs(const ClusterPlanes& planes, std::size_t count, std::uint32_t radius, const PairScratch& scratch,
                       const PairLists& pairs) {
  // Beyond the last cluster lie boxes so large that nobody chooses them.
  constexpr float huge = 1e18f;
  for (std::size_t p = 0; p < ClusterPlanes::box_planes; ++p) {
    std::fill_n(planes.boxes[p] + count, cluster_padding, p < 3 ? -huge : huge);
  }
  return HWY_DYNAMIC_DISPATCH(FindPairs)(planes, count, radius, scratch, pairs);
}

std::size_t remove_joined(const ClusterPlanes& planes, std::size_t count, const std::int32_t* partners) {
  return HWY_DYNAMIC_DISPATCH(RemoveJoined)(planes, count, partners);
}

}  // namespace boxwood
#endif
