// The inner loops of binned building, one source for all instruction sets. A reference's box is one register of eight
// floats, or two of four; nothing is fused, so every instruction set chooses alike.
#include "build/bin_kernels.h"

#include <algorithm>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "build/bin_kernels.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace boxwood {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

/// A box is one register, two, or, where there are none, eight numbers.
constexpr std::size_t box_lanes = HWY_MAX_BYTES >= 32 ? 8 : HWY_MAX_BYTES >= 16 ? 4 : 1;
constexpr std::size_t box_parts = 8 / box_lanes;
constexpr std::size_t point_lanes = box_lanes == 1 ? 1 : 4;
constexpr std::size_t point_parts = 4 / point_lanes;
using BoxTag = hn::FixedTag<float, box_lanes>;
using PointTag = hn::FixedTag<float, point_lanes>;
using PlaceTag = hn::FixedTag<std::int32_t, point_lanes>;

struct BoxVector {
  hn::Vec<BoxTag> parts[box_parts];
};
struct PointVector {
  hn::Vec<PointTag> parts[point_parts];
};

HWY_INLINE BoxVector LoadBox(const float* from) {
  BoxVector out;
  for (std::size_t p = 0; p < box_parts; ++p) out.parts[p] = hn::Load(BoxTag(), from + p * box_lanes);
  return out;
}

HWY_INLINE void StoreBox(const BoxVector& box, float* to) {
  for (std::size_t p = 0; p < box_parts; ++p) hn::Store(box.parts[p], BoxTag(), to + p * box_lanes);
}

HWY_INLINE BoxVector EmptyBox() {
  constexpr float none = -Box4::infinity;
  alignas(32) constexpr float lanes[8] = {none, none, none, 0, none, none, none, 0};
  return LoadBox(lanes);
}

HWY_INLINE BoxVector Unite(const BoxVector& a, const BoxVector& b) {
  BoxVector out;
  for (std::size_t p = 0; p < box_parts; ++p) out.parts[p] = hn::Max(a.parts[p], b.parts[p]);
  return out;
}

/// Changes the sign of the first three lanes.
HWY_INLINE BoxVector NegateLower(const BoxVector& box) {
  alignas(32) constexpr float signs[8] = {-0.0f, -0.0f, -0.0f, 0, 0, 0, 0, 0};
  const BoxVector sign = LoadBox(signs);
  BoxVector out;
  for (std::size_t p = 0; p < box_parts; ++p) out.parts[p] = hn::Xor(box.parts[p], sign.parts[p]);
  return out;
}

/// A reference's corners as they are. The fourth lanes, which hold other things, are set to 0: they would cost slow
/// arithmetic.
HWY_INLINE BoxVector LoadCorners(const Reference& reference) {
  alignas(32) constexpr std::uint32_t keep[8] = {~0u, ~0u, ~0u, 0, ~0u, ~0u, ~0u, 0};
  const BoxVector mask = LoadBox(reinterpret_cast<const float*>(keep));
  BoxVector box = LoadBox(&reference.lower.x);
  for (std::size_t p = 0; p < box_parts; ++p) box.parts[p] = hn::And(box.parts[p], mask.parts[p]);
  return box;
}

/// Of corners the doubled centre, of a grown box the extent.
HWY_INLINE PointVector SumOfHalves(const BoxVector& box) {
  PointVector sum;
#if HWY_MAX_BYTES >= 32
  sum.parts[0] = hn::Add(hn::UpperHalf(PointTag(), box.parts[0]), hn::LowerHalf(PointTag(), box.parts[0]));
#else
  for (std::size_t p = 0; p < point_parts; ++p) sum.parts[p] = hn::Add(box.parts[point_parts + p], box.parts[p]);
#endif
  return sum;
}

/// The point in both halves.
HWY_INLINE BoxVector DoublePoint(const PointVector& point) {
  BoxVector out;
#if HWY_MAX_BYTES >= 32
  out.parts[0] = hn::Combine(BoxTag(), point.parts[0], point.parts[0]);
#else
  for (std::size_t p = 0; p < box_parts; ++p) out.parts[p] = point.parts[p % point_parts];
#endif
  return out;
}

/// One coordinate of a doubled point, in all lanes of a part.
class PickAxis {
 public:
#if HWY_TARGET == HWY_SCALAR
  explicit PickAxis(std::int32_t axis) : axis_(static_cast<std::size_t>(axis)) {}
  HWY_INLINE hn::Vec<BoxTag> operator()(const BoxVector& point) const { return point.parts[axis_]; }

 private:
  std::size_t axis_;
#else
  explicit PickAxis(std::int32_t axis) {
    const auto lane_bytes = 0x03020100u + 0x04040404u * static_cast<std::uint32_t>(axis);
    bytes_ = hn::BitCast(Bytes(), hn::Set(hn::RebindToUnsigned<BoxTag>(), lane_bytes));
  }
  HWY_INLINE hn::Vec<BoxTag> operator()(const BoxVector& point) const {
    return hn::BitCast(BoxTag(), hn::TableLookupBytes(hn::BitCast(Bytes(), point.parts[0]), bytes_));
  }

 private:
  using Bytes = hn::Repartition<std::uint8_t, BoxTag>;
  hn::Vec<Bytes> bytes_;
#endif
};

HWY_INLINE PointVector LoadPoint(const Float4& point) {
  PointVector out;
  const float* lanes = reinterpret_cast<const float*>(&point);
  for (std::size_t p = 0; p < point_parts; ++p) out.parts[p] = hn::Load(PointTag(), lanes + p * point_lanes);
  return out;
}

void FillBins(std::span<const Reference> references, const BinScale& scale, const BinRows& rows) {
  for (std::uint32_t axis = 0; axis < 3; ++axis) {
    for (std::uint32_t b = 0; b < rows.bins; ++b) StoreBox(EmptyBox(), rows.boxes[axis * rows.stride + b].lanes);
    std::fill_n(rows.counts + axis * rows.stride, rows.bins, 0u);
  }
  const PointVector origin = LoadPoint(scale.origin), factor = LoadPoint(scale.scale), last = LoadPoint(scale.last);
  const auto stride = static_cast<std::int32_t>(rows.stride);
  for (const Reference& reference : references) {
    const BoxVector corners = LoadCorners(reference);
    const PointVector center = SumOfHalves(corners);
    alignas(16) std::int32_t bins[4];
    for (std::size_t p = 0; p < point_parts; ++p) {
      const auto at = hn::Mul(hn::Sub(center.parts[p], origin.parts[p]), factor.parts[p]);
      const auto inside = hn::Max(hn::Min(at, last.parts[p]), hn::Zero(PointTag()));
      hn::Store(hn::ConvertTo(PlaceTag(), inside), PlaceTag(), bins + p * point_lanes);
    }
    const BoxVector box = NegateLower(corners);
    for (std::int32_t axis = 0; axis < 3; ++axis) {
      const auto place = static_cast<std::size_t>(axis * stride + bins[axis]);
      float* const lanes = rows.boxes[place].lanes;
      StoreBox(Unite(LoadBox(lanes), box), lanes);
      ++rows.counts[place];
    }
  }
}

HWY_INLINE Box4 ToBox4(const BoxVector& grown) {
  Box4 out;
  StoreBox(NegateLower(grown), reinterpret_cast<float*>(&out));
  return out;
}

using Borders = hn::CappedTag<float, 8>;

/// Sides of the borders of one axis: border b lies before bin b.
struct BorderSides {
  alignas(64) float extents[4 * max_swept_bins];
  alignas(64) std::uint32_t counts[max_swept_bins];

  HWY_INLINE void Set(std::uint32_t border, const BoxVector& box, std::uint32_t count) {
    const PointVector extent = SumOfHalves(box);
    for (std::size_t p = 0; p < point_parts; ++p) {
      hn::Store(extent.parts[p], PointTag(), extents + 4 * border + p * point_lanes);
    }
    counts[border] = count;
  }
  HWY_INLINE hn::Vec<Borders> Cost(std::uint32_t border, std::uint32_t shift) const {
    const Borders floats;
    const hn::RebindToSigned<Borders> ints;
    hn::Vec<Borders> x, y, z, unused;
    hn::LoadInterleaved4(floats, extents + 4 * border, x, y, z, unused);
    const auto area = hn::Add(hn::Add(hn::Mul(x, y), hn::Mul(y, z)), hn::Mul(z, x));
    const auto count = hn::Load(ints, reinterpret_cast<const std::int32_t*>(counts) + border);
    const auto rounded = hn::Add(count, hn::Set(ints, (1 << shift) - 1));
    const auto cost = hn::Mul(area, hn::ConvertTo(floats, hn::ShiftRightSame(rounded, static_cast<int>(shift))));
    return hn::IfThenElse(hn::RebindMask(floats, hn::Eq(count, hn::Zero(ints))), hn::Set(floats, Box4::infinity), cost);
  }
};

/// Costs of the borders of one axis. Of those that nothing lies on one side of, infinite.
HWY_INLINE void SweepAxis(const GrownBox* boxes, const std::uint32_t* counts, std::uint32_t bins,
                          std::uint32_t block_shift, float* costs) {
  BorderSides left, right;
  BoxVector box = EmptyBox();
  std::uint32_t count = 0;
  for (std::uint32_t b = 1; b < bins; ++b) {
    box = Unite(box, LoadBox(boxes[b - 1].lanes));
    left.Set(b, box, count += counts[b - 1]);
  }
  box = EmptyBox();
  count = 0;
  for (std::uint32_t b = bins - 1; b > 0; --b) {
    box = Unite(box, LoadBox(boxes[b].lanes));
    right.Set(b, box, count += counts[b]);
  }
  const auto lanes = static_cast<std::uint32_t>(hn::Lanes(Borders()));
  left.Set(0, EmptyBox(), 0);
  right.Set(0, EmptyBox(), 0);
  for (std::uint32_t b = bins; b % lanes != 0; ++b) left.Set(b, EmptyBox(), 0), right.Set(b, EmptyBox(), 0);
  for (std::uint32_t b = 0; b < bins; b += lanes) {
    hn::Store(hn::Add(left.Cost(b, block_shift), right.Cost(b, block_shift)), Borders(), costs + b);
  }
}

BinBorder CheapestBorder(const BinRows& rows, std::uint32_t block_shift) {
  BinBorder best;
  for (std::uint32_t axis = 0; axis < 3; ++axis) {
    alignas(64) float costs[max_swept_bins];
    SweepAxis(rows.boxes + axis * rows.stride, rows.counts + axis * rows.stride, rows.bins, block_shift, costs);
    for (std::uint32_t b = 1; b < rows.bins; ++b) {
      if (!(costs[b] < best.cost)) continue;
      best.cost = costs[b];
      best.axis = static_cast<std::int32_t>(axis);
      best.border = static_cast<std::int32_t>(b);
    }
  }
  if (best.border == 0) return best;
  const std::size_t first = static_cast<std::size_t>(best.axis) * rows.stride;
  BoxVector sides[2] = {EmptyBox(), EmptyBox()};
  std::uint32_t counts[2] = {};
  for (std::uint32_t b = 0; b < rows.bins; ++b) {
    const std::size_t side = b < static_cast<std::uint32_t>(best.border) ? 0 : 1;
    sides[side] = Unite(sides[side], LoadBox(rows.boxes[first + b].lanes));
    counts[side] += rows.counts[first + b];
  }
  best.left = ToBox4(sides[0]);
  best.right = ToBox4(sides[1]);
  best.left_count = counts[0];
  best.right_count = counts[1];
  return best;
}

std::size_t DivideAt(std::span<Reference> references, const BinScale& scale, std::int32_t axis, std::int32_t border,
                     Box4& front_centers, Box4& back_centers) {
  // Bins are not needed: below a border is below its number.
  const BoxVector origin = DoublePoint(LoadPoint(scale.origin)), factor = DoublePoint(LoadPoint(scale.scale));
  const auto end = hn::Set(BoxTag(), static_cast<float>(border));
  const PickAxis on_axis(axis);
  BoxVector front = EmptyBox(), back = EmptyBox();
  const BoxVector nothing = EmptyBox();
  std::size_t in_front = 0;
  // Without a branch on the outcome, which nothing could predict.
  for (Reference& reference : references) {
    const BoxVector moved = LoadBox(&reference.lower.x);
    const BoxVector center = DoublePoint(SumOfHalves(LoadCorners(reference)));
    BoxVector at;
    for (std::size_t p = 0; p < box_parts; ++p) {
      at.parts[p] = hn::Mul(hn::Sub(center.parts[p], origin.parts[p]), factor.parts[p]);
    }
    const auto is_front = hn::Lt(on_axis(at), end);
    const BoxVector grown = NegateLower(center);
    for (std::size_t p = 0; p < box_parts; ++p) {
      front.parts[p] = hn::Max(front.parts[p], hn::IfThenElse(is_front, grown.parts[p], nothing.parts[p]));
      back.parts[p] = hn::Max(back.parts[p], hn::IfThenElse(is_front, nothing.parts[p], grown.parts[p]));
    }
    Reference& next = references[in_front];
    StoreBox(LoadBox(&next.lower.x), &reference.lower.x);
    StoreBox(moved, &next.lower.x);
    in_front += hn::AllTrue(BoxTag(), is_front) ? 1 : 0;
  }
  front_centers = ToBox4(front);
  back_centers = ToBox4(back);
  return in_front;
}

}  // namespace HWY_NAMESPACE
}  // namespace boxwood
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace boxwood {

HWY_EXPORT(FillBins);
HWY_EXPORT(CheapestBorder);
HWY_EXPORT(DivideAt);

void fill_bins(std::span<const Reference> references, const BinScale& scale, const BinRows& rows) {
  HWY_DYNAMIC_DISPATCH(FillBins)(references, scale, rows);
}

BinBorder cheapest_border(const BinRows& rows, std::uint32_t block_shift) {
  return HWY_DYNAMIC_DISPATCH(CheapestBorder)(rows, block_shift);
}

std::size_t divide_at(std::span<Reference> references, const BinScale& scale, std::int32_t axis, std::int32_t border,
                      Box4& front_centers, Box4& back_centers) {
  return HWY_DYNAMIC_DISPATCH(DivideAt)(references, scale, axis, border, front_centers, back_centers);
}

}  // namespace boxwood
#endif
