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

/// Adds references to bins.
class BinFiller {
 public:
  HWY_INLINE explicit BinFiller(const BinScale& scale)
      : origin_(LoadPoint(scale.origin)), scale_(LoadPoint(scale.scale)), last_(LoadPoint(scale.last)) {}

  /// Sets places[axis] to that of the reference's bin in the rows.
  HWY_INLINE void Place(const Reference& reference, std::int32_t* places) const {
    const PointVector center = SumOfHalves(LoadCorners(reference));
    alignas(16) constexpr std::int32_t axes[4] = {0, 1, 2, 3};
    for (std::size_t p = 0; p < point_parts; ++p) {
      const auto at = hn::Mul(hn::Sub(center.parts[p], origin_.parts[p]), scale_.parts[p]);
      const auto inside = hn::Max(hn::Min(at, last_.parts[p]), hn::Zero(PointTag()));
      const auto bin = hn::ConvertTo(PlaceTag(), inside);
      const auto axis = hn::Load(PlaceTag(), axes + p * point_lanes);
      hn::Store(hn::Add(hn::ShiftLeft<2>(bin), axis), PlaceTag(), places + p * point_lanes);
    }
  }

  static HWY_INLINE void Add(const Reference& reference, const std::int32_t* places, GrownBox* boxes,
                             std::uint32_t* counts) {
    const BoxVector box = NegateLower(LoadCorners(reference));
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const auto place = static_cast<std::uint32_t>(places[axis]);
      float* const lanes = boxes[place].lanes;
      StoreBox(Unite(LoadBox(lanes), box), lanes);
      ++counts[place];
    }
  }

 private:
  PointVector origin_, scale_, last_;
};

/// Fills `sets` sets of bins, whose references go to them in turn, and unites them in the first, that of the rows.
template <std::size_t sets>
HWY_INLINE void FillSets(std::span<const Reference> references, const BinScale& scale, const BinRows& rows) {
  constexpr std::size_t more = sets > 1 ? sets - 1 : 1;
  GrownBox more_boxes[more][4 * max_bins_in_rows];
  std::uint32_t more_counts[more][4 * max_bins_in_rows];
  GrownBox* boxes[sets] = {rows.boxes};
  std::uint32_t* counts[sets] = {rows.counts};
  for (std::size_t s = 1; s < sets; ++s) {
    boxes[s] = more_boxes[s - 1];
    counts[s] = more_counts[s - 1];
  }
  const std::uint32_t places = 4 * rows.bins;
  for (std::size_t s = 0; s < sets; ++s) {
    for (std::uint32_t b = 0; b < places; ++b) StoreBox(EmptyBox(), boxes[s][b].lanes);
    std::fill_n(counts[s], places, 0u);
  }
  // Places first: boxes are then loaded and stored at addresses that are known long before.
  constexpr std::size_t chunk = 64;
  const BinFiller filler(scale);
  alignas(16) std::int32_t of_chunk[chunk][4];
  for (std::size_t first = 0; first < references.size(); first += chunk) {
    const std::span<const Reference> some = references.subspan(first, std::min(chunk, references.size() - first));
    for (std::size_t i = 0; i < some.size(); ++i) filler.Place(some[i], of_chunk[i]);
    std::size_t i = 0;
    for (; i + sets <= some.size(); i += sets) {
      for (std::size_t s = 0; s < sets; ++s) BinFiller::Add(some[i + s], of_chunk[i + s], boxes[s], counts[s]);
    }
    for (; i < some.size(); ++i) BinFiller::Add(some[i], of_chunk[i], rows.boxes, rows.counts);
  }
  for (std::size_t s = 1; s < sets; ++s) {
    for (std::uint32_t b = 0; b < places; ++b) {
      StoreBox(Unite(LoadBox(rows.boxes[b].lanes), LoadBox(boxes[s][b].lanes)), rows.boxes[b].lanes);
      rows.counts[b] += counts[s][b];
    }
  }
}

void FillBins(std::span<const Reference> references, const BinScale& scale, const BinRows& rows) {
  // Neighbours often fall into the same bin, and what has just been stored is long in coming back. So they go to bins
  // of their own, unless they are so few that emptying those costs more.
  constexpr std::size_t few = 64, many = 512;
  if (references.size() < few) return FillSets<1>(references, scale, rows);
  if (references.size() < many) return FillSets<2>(references, scale, rows);
  FillSets<4>(references, scale, rows);
}

HWY_INLINE Box4 ToBox4(const BoxVector& grown) {
  Box4 out;
  StoreBox(NegateLower(grown), reinterpret_cast<float*>(&out));
  return out;
}

/// One side of a border on each of the three axes.
struct Side {
  BoxVector boxes[3];
  hn::Vec<PlaceTag> counts[point_parts];

  HWY_INLINE void Clear() {
    for (BoxVector& box : boxes) box = EmptyBox();
    for (auto& count : counts) count = hn::Zero(PlaceTag());
  }
  HWY_INLINE void Grow(const BinRows& rows, std::uint32_t bin) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      boxes[axis] = Unite(boxes[axis], LoadBox(rows.boxes[4 * bin + axis].lanes));
    }
    const auto* from = reinterpret_cast<const std::int32_t*>(rows.counts) + 4 * bin;
    for (std::size_t p = 0; p < point_parts; ++p) {
      counts[p] = hn::Add(counts[p], hn::LoadU(PlaceTag(), from + p * point_lanes));
    }
  }
};

/// Half areas, one per axis.
HWY_INLINE PointVector HalfAreas(const BoxVector (&boxes)[3]) {
  PointVector out;
#if HWY_TARGET == HWY_SCALAR
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const PointVector e = SumOfHalves(boxes[axis]);
    out.parts[axis] = hn::Add(hn::Add(hn::Mul(e.parts[0], e.parts[1]), hn::Mul(e.parts[1], e.parts[2])),
                              hn::Mul(e.parts[2], e.parts[0]));
  }
  out.parts[3] = hn::Zero(PointTag());
#else
  const PointTag d;
  const auto first = SumOfHalves(boxes[0]).parts[0], second = SumOfHalves(boxes[1]).parts[0];
  const auto third = SumOfHalves(boxes[2]).parts[0], zero = hn::Zero(d);
  const auto low = hn::InterleaveLower(d, first, second), high = hn::InterleaveUpper(d, first, second);
  const auto low_third = hn::InterleaveLower(d, third, zero), high_third = hn::InterleaveUpper(d, third, zero);
  const auto x = hn::ConcatLowerLower(d, low_third, low), y = hn::ConcatUpperUpper(d, low_third, low);
  const auto z = hn::ConcatLowerLower(d, high_third, high);
  out.parts[0] = hn::Add(hn::Add(hn::Mul(x, y), hn::Mul(y, z)), hn::Mul(z, x));
#endif
  return out;
}

/// Area times price, one per axis. Where there is nothing, infinite.
HWY_INLINE PointVector Costs(const Side& side, std::uint32_t block_shift) {
  const PlaceTag ints;
  PointVector out = HalfAreas(side.boxes);
  for (std::size_t p = 0; p < point_parts; ++p) {
    const auto rounded = hn::Add(side.counts[p], hn::Set(ints, (1 << block_shift) - 1));
    const auto blocks = hn::ConvertTo(PointTag(), hn::ShiftRightSame(rounded, static_cast<int>(block_shift)));
    const auto none = hn::RebindMask(PointTag(), hn::Eq(side.counts[p], hn::Zero(ints)));
    out.parts[p] = hn::IfThenElse(none, hn::Set(PointTag(), Box4::infinity), hn::Mul(out.parts[p], blocks));
  }
  return out;
}

BinBorder CheapestBorder(const BinRows& rows, std::uint32_t block_shift) {
  PointVector right_costs[max_bins_in_rows];
  Side right;
  right.Clear();
  for (std::uint32_t b = rows.bins - 1; b > 0; --b) {
    right.Grow(rows, b);
    right_costs[b] = Costs(right, block_shift);
  }
  // The first of the cheapest borders of each axis.
  PointVector least, border;
  for (std::size_t p = 0; p < point_parts; ++p) {
    least.parts[p] = hn::Set(PointTag(), Box4::infinity);
    border.parts[p] = hn::Zero(PointTag());
  }
  Side left;
  left.Clear();
  for (std::uint32_t b = 1; b < rows.bins; ++b) {
    left.Grow(rows, b - 1);
    const PointVector left_costs = Costs(left, block_shift);
    for (std::size_t p = 0; p < point_parts; ++p) {
      const auto cost = hn::Add(left_costs.parts[p], right_costs[b].parts[p]);
      const auto cheaper = hn::Lt(cost, least.parts[p]);
      least.parts[p] = hn::IfThenElse(cheaper, cost, least.parts[p]);
      border.parts[p] = hn::IfThenElse(cheaper, hn::Set(PointTag(), static_cast<float>(b)), border.parts[p]);
    }
  }
  alignas(16) float costs[4], borders[4];
  for (std::size_t p = 0; p < point_parts; ++p) {
    hn::Store(least.parts[p], PointTag(), costs + p * point_lanes);
    hn::Store(border.parts[p], PointTag(), borders + p * point_lanes);
  }
  BinBorder best;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    if (!(costs[axis] < best.cost)) continue;
    best.cost = costs[axis];
    best.axis = static_cast<std::int32_t>(axis);
    best.border = static_cast<std::int32_t>(borders[axis]);
  }
  BoxVector sides[2] = {EmptyBox(), EmptyBox()};
  std::uint32_t counts[2] = {};
  for (std::uint32_t b = 0; b < rows.bins; ++b) {
    const std::size_t side = b < static_cast<std::uint32_t>(best.border) ? 0 : 1;
    const std::size_t place = 4 * std::size_t{b} + static_cast<std::size_t>(best.axis);
    sides[side] = Unite(sides[side], LoadBox(rows.boxes[place].lanes));
    counts[side] += rows.counts[place];
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
