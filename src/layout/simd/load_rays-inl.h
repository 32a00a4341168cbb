// Rays put into slots eight at a time: prepared side by side with the bits of prepare(), and transposed on the way in
// and out. Compiled once per instruction set that has eight lanes.
#if defined(BOXWOOD_LAYOUT_SIMD_LOAD_RAYS_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef BOXWOOD_LAYOUT_SIMD_LOAD_RAYS_INL_H
#undef BOXWOOD_LAYOUT_SIMD_LOAD_RAYS_INL_H
#else
#define BOXWOOD_LAYOUT_SIMD_LOAD_RAYS_INL_H
#endif

#include <algorithm>
#include <span>

#include "layout/simd/slots-inl.h"

HWY_BEFORE_NAMESPACE();
namespace boxwood {
namespace HWY_NAMESPACE {
#if HWY_MAX_BYTES >= 32

using EightFloats = hn::FixedTag<float, 8>;
using OfEight = hn::Vec<EightFloats>;

/// Rows become columns.
HWY_INLINE void transpose_eight(OfEight (&rows)[8]) {
  const EightFloats d;
  const hn::Repartition<double, EightFloats> pairs;
  OfEight twos[8], fours[8];
  for (int i = 0; i < 8; i += 2) {
    twos[i] = hn::InterleaveLower(d, rows[i], rows[i + 1]);
    twos[i + 1] = hn::InterleaveUpper(d, rows[i], rows[i + 1]);
  }
  for (int i = 0; i < 8; i += 4) {
    for (int half = 0; half < 2; ++half) {
      const auto a = hn::BitCast(pairs, twos[i + half]), b = hn::BitCast(pairs, twos[i + half + 2]);
      fours[i + 2 * half] = hn::BitCast(d, hn::InterleaveLower(pairs, a, b));
      fours[i + 2 * half + 1] = hn::BitCast(d, hn::InterleaveUpper(pairs, a, b));
    }
  }
  for (int i = 0; i < 4; ++i) {
    rows[i] = hn::ConcatLowerLower(d, fours[i + 4], fours[i]);
    rows[i + 4] = hn::ConcatUpperUpper(d, fours[i + 4], fours[i]);
  }
}

/// The dominant axis of eight directions, and coordinates in the order of a ray's own axes: that one last.
struct EightAxes {
  hn::Mask<EightFloats> x, y;  // dominant; z where neither is

  HWY_INLINE explicit EightAxes(const OfEight (&size)[3])
      : x(hn::And(hn::Gt(size[0], size[1]), hn::Gt(size[0], size[2]))),
        y(hn::AndNot(hn::Gt(size[0], size[1]), hn::Gt(size[1], size[2]))) {}
  /// Of what holds where x, y or z is dominant.
  HWY_INLINE OfEight pick(OfEight at_x, OfEight at_y, OfEight at_z) const {
    return hn::IfThenElse(x, at_x, hn::IfThenElse(y, at_y, at_z));
  }
  HWY_INLINE OfEight first(const OfEight (&v)[3]) const { return pick(v[1], v[2], v[0]); }
  HWY_INLINE OfEight second(const OfEight (&v)[3]) const { return pick(v[2], v[0], v[1]); }
  HWY_INLINE OfEight dominant(const OfEight (&v)[3]) const { return pick(v[0], v[1], v[2]); }
};

/// Which of eight rays are within the limits of `Ray` and which begin at 0 or later, a bit each.
struct LoadedRays {
  std::uint32_t valid, forward;
};

/// Fills slots with eight rays, all but their place in a tree and what they have found. ray(i) and slot(i): the i-th.
/// RowBytes: of the rows of a node. The slots of rays that are not valid hold nothing of use.
template <std::uint32_t RowBytes, class RayAt, class SlotAt>
HWY_INLINE LoadedRays load_eight(float reach, RayAt ray, SlotAt slot) {
  const EightFloats d;
  const hn::RebindToSigned<EightFloats> di;
  const auto integers = [&](std::int32_t value) HWY_ATTR { return hn::BitCast(d, hn::Set(di, value)); };
  OfEight in[8];  // origin, t_near, direction, t_far
  for (int i = 0; i < 8; ++i) in[i] = hn::LoadU(d, &ray(i).origin.x);
  transpose_eight(in);
  const OfEight origin[3] = {in[0], in[1], in[2]}, direction[3] = {in[4], in[5], in[6]};
  const OfEight size[3] = {hn::Abs(in[4]), hn::Abs(in[5]), hn::Abs(in[6])};
  const EightAxes axes(size);
  const OfEight dominant = axes.dominant(direction), largest = hn::Abs(dominant);

  const OfEight limit = hn::Set(d, largest_coordinate);
  auto valid = hn::And(hn::Le(in[3], in[7]), hn::Ge(largest, hn::Set(d, 1 / largest_coordinate)));
  OfEight magnitude = hn::Set(d, 0x1p-26f);
  for (int axis = 0; axis < 3; ++axis) {
    const OfEight distance = hn::Abs(origin[axis]);
    valid = hn::And(valid, hn::And(hn::Le(size[axis], limit), hn::Le(distance, limit)));
    magnitude = hn::Max(hn::Add(distance, hn::Set(d, reach)), magnitude);
  }

  const OfEight one = hn::Set(d, 1.0f), zero = hn::Zero(d);
  const OfEight bound = hn::Mul(magnitude, hn::Set(d, 0x1p-19f)), least = hn::Mul(largest, hn::Set(d, 1e-9f));
  OfEight inverse[3], near_offset[3], far_offset[3], near_row[3];
  for (int axis = 0; axis < 3; ++axis) {
    inverse[axis] = hn::Div(one, hn::CopySign(hn::Max(size[axis], least), direction[axis]));
    const OfEight center = hn::Mul(origin[axis], inverse[axis]), slack = hn::Mul(bound, hn::Abs(inverse[axis]));
    near_offset[axis] = hn::Add(center, slack);
    far_offset[axis] = hn::Sub(center, slack);
    const auto negative = hn::RebindMask(d, hn::Lt(hn::BitCast(di, direction[axis]), hn::Zero(di)));
    const auto row = static_cast<std::int32_t>(2 * static_cast<std::uint32_t>(axis) * RowBytes);
    // Sixteen bits each: x and y are in one word.
    constexpr auto other = static_cast<std::int32_t>(RowBytes);
    const int shift = axis == 1 ? 16 : 0;
    near_row[axis] = hn::IfThenElse(negative, integers((row + other) << shift), integers(row << shift));
  }

  // In the order of Slot. Limits are never -0: they are compared as integers.
  OfEight out[3][8] = {
      {inverse[0], inverse[1], inverse[2], near_offset[0], near_offset[1], near_offset[2], far_offset[0],
       far_offset[1]},
      {far_offset[2], hn::Add(in[3], zero), hn::Add(in[7], zero), hn::Or(near_row[0], near_row[1]), near_row[2], zero,
       zero, zero},
      {axes.first(origin), axes.second(origin), axes.dominant(origin), hn::Div(axes.first(direction), dominant),
       hn::Div(axes.second(direction), dominant), hn::Div(one, dominant),
       axes.pick(integers(1), integers(2), integers(0)), axes.pick(integers(2), integers(0), integers(1))}};
  alignas(32) float last_axes[8];
  hn::Store(axes.pick(integers(0), integers(1), integers(2)), d, last_axes);
  for (int part = 0; part < 3; ++part) {
    transpose_eight(out[part]);
    for (int i = 0; i < 8; ++i) hn::Store(out[part][i], d, reinterpret_cast<float*>(&slot(i)) + 8 * part);
  }
  for (int i = 0; i < 8; ++i) slot(i).leaf.axes[2] = std::bit_cast<std::uint32_t>(last_axes[i]);
  return {bits_of(d, valid), bits_of(d, hn::Ge(in[3], zero))};
}

/// Fetches some rays of a batch from `begin` on, as far as there are any.
HWY_INLINE void prefetch_rays(std::span<const Ray> rays, std::size_t begin, std::size_t count) {
  constexpr std::size_t per_line = 64 / sizeof(Ray);
  for (std::size_t i = 0; i < count; i += per_line) __builtin_prefetch(&rays[std::min(begin + i, rays.size() - 1)]);
}
/// How far ahead of those that are being prepared.
inline constexpr std::size_t rays_ahead = 32;

/// Puts the rays of a batch into slots, in order. Entry: of the stacks.
template <std::uint32_t RowBytes, class Entry>
class IncomingRays {
 public:
  IncomingRays(std::span<const Ray> rays, const WideView& view) : rays_(rays), view_(view) {}

  /// Takes free slots, eight or all that are left at a time, for the next rays in front of the root of the tree.
  /// Arrivals: bottom, the end of a stack; admitted(which are what), whose bits say which rays go to `nodes`;
  /// expect(index of a ray), when it comes; refuse(index), when it isn't admitted.
  template <class Arrivals>
  HWY_INLINE void fill(const Slots& slots, SlotList& free, SlotList& nodes, const Arrivals& arrivals) {
    while (next_ < rays_.size() && free.size >= std::min<std::size_t>(8, rays_.size() - next_)) {
      put_eight(slots, free, nodes, arrivals);
    }
  }

 private:
  template <class Arrivals>
  HWY_NOINLINE void put_eight(const Slots& slots, SlotList& free, SlotList& nodes, const Arrivals& arrivals) {
    const auto count = static_cast<std::uint32_t>(std::min<std::size_t>(8, rays_.size() - next_));
    const auto first = static_cast<std::uint32_t>(next_);
    free.size -= count;
    next_ += count;
    const std::uint32_t* const offsets = free.offsets + free.size;
    prefetch_rays(rays_, first + rays_ahead, 8);
    // Missing rays are the last one again.
    const LoadedRays loaded = load_eight<RowBytes>(
        view_.reach,
        [&](std::size_t i) HWY_ATTR -> const Ray& { return rays_[first + std::min<std::size_t>(i, count - 1)]; },
        [&](std::size_t i) HWY_ATTR -> Slot& { return i < count ? slots.at(offsets[i]) : spare_; });
    for (std::uint32_t i = 0; i < count; ++i) {
      start(slots.at(offsets[i]), first + i, Arrivals::bottom);
      arrivals.expect(first + i);
    }
    const std::uint32_t all = (1u << count) - 1, admitted = Arrivals::admitted(loaded) & all;
    if (HWY_LIKELY(admitted == all)) return nodes.add(offsets, count);
    for (std::uint32_t i = 0; i < count; ++i) {
      const bool admit = (admitted >> i & 1) != 0;
      if (!admit) arrivals.refuse(first + i);
      (admit ? nodes : free).add(offsets[i]);
    }
  }

  HWY_INLINE void start(Slot& slot, std::uint32_t index, Entry bottom) const {
    Entry* const end = bottom_of<Entry>(slot);
    *end = bottom;
    slot.top = end + 1;
    slot.next = view_.root;
    slot.best = Hit{};
    slot.index = index;
  }

  std::span<const Ray> rays_;
  const WideView& view_;
  std::size_t next_ = 0;
  Slot spare_;
};

#endif  // HWY_MAX_BYTES >= 32
}  // namespace HWY_NAMESPACE
}  // namespace boxwood
HWY_AFTER_NAMESPACE();
#endif
