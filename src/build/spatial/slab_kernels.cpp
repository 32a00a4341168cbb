// Cuts triangles at the borders of slabs, eight slabs at a time; one source for all instruction sets. Nothing is fused,
// so every instruction set cuts alike.
#include "build/spatial/slab_kernels.h"

#include <algorithm>
#include <utility>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "build/spatial/slab_kernels.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace boxwood {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using SlabTag = hn::CappedTag<float, slab_padding>;
using SlabVector = hn::Vec<SlabTag>;
using SlabMask = hn::Mask<SlabTag>;

HWY_INLINE SlabVector InAllSlabs(float value) { return hn::Set(SlabTag(), value); }

/// Extent of parts on one axis, slab by slab.
struct PartRange {
  SlabVector lower, upper;

  HWY_INLINE void Clear() {
    lower = InAllSlabs(Box4::infinity);
    upper = InAllSlabs(-Box4::infinity);
  }
  HWY_INLINE void Grow(SlabVector from, SlabVector to, SlabMask where) {
    lower = hn::Min(lower, hn::IfThenElse(where, hn::Min(from, to), InAllSlabs(Box4::infinity)));
    upper = hn::Max(upper, hn::IfThenElse(where, hn::Max(from, to), InAllSlabs(-Box4::infinity)));
  }
  HWY_INLINE void Limit(float least, float most) {
    lower = hn::Max(lower, InAllSlabs(least));
    upper = hn::Min(upper, InAllSlabs(most));
  }
};

/// The axis that slabs divide, then the other two.
struct AxisOrder {
  explicit AxisOrder(std::int32_t axis)
      : divided(static_cast<std::size_t>(axis)), others{(divided + 1) % 3, (divided + 2) % 3} {}
  std::size_t divided, others[2];
};

/// Grows the ranges by the part of an edge that lies between `begin` and `end` of each slab.
HWY_INLINE void AddEdge(const Vec3& from, const Vec3& to, const AxisOrder& axes, SlabVector begin, SlabVector end,
                        PartRange (&ranges)[2]) {
  const bool ascends = from[axes.divided] <= to[axes.divided];
  const Vec3 &low = ascends ? from : to, &high = ascends ? to : from;
  const float first = low[axes.divided], last = high[axes.divided];
  SlabVector t_begin = InAllSlabs(0), t_end = InAllSlabs(1);
  if (first < last) {
    const SlabVector start = InAllSlabs(first), per_length = InAllSlabs(1 / (last - first));
    t_begin = hn::Min(hn::Max(hn::Mul(hn::Sub(begin, start), per_length), t_begin), t_end);
    t_end = hn::Max(hn::Min(hn::Mul(hn::Sub(end, start), per_length), t_end), InAllSlabs(0));
  }
  const SlabMask meets = hn::And(hn::Le(InAllSlabs(first), end), hn::Ge(InAllSlabs(last), begin));
  for (std::size_t i = 0; i < 2; ++i) {
    const std::size_t axis = axes.others[i];
    const SlabVector start = InAllSlabs(low[axis]), length = InAllSlabs(high[axis] - low[axis]);
    ranges[i].Grow(hn::Add(start, hn::Mul(length, t_begin)), hn::Add(start, hn::Mul(length, t_end)), meets);
  }
}

/// Boxes in slabs, one array per plane.
struct SlabPlanes {
  alignas(64) float lower[3][max_slabs + slab_padding], upper[3][max_slabs + slab_padding];

  HWY_INLINE void Grow(std::size_t axis, std::size_t slab, SlabVector from, SlabVector to, SlabMask where) {
    const SlabTag d;
    const SlabVector least = hn::IfThenElse(where, from, InAllSlabs(Box4::infinity));
    const SlabVector most = hn::IfThenElse(where, to, InAllSlabs(-Box4::infinity));
    hn::Store(hn::Min(hn::Load(d, lower[axis] + slab), least), d, lower[axis] + slab);
    hn::Store(hn::Max(hn::Load(d, upper[axis] + slab), most), d, upper[axis] + slab);
  }
};

/// Adds the parts of a reference in the slabs [first, last].
void AddParts(const Reference& reference, const Geometry& geometry, const SlabAxis& slabs, std::uint32_t first,
              std::uint32_t last, SlabPlanes& planes) {
  const SlabTag d;
  const auto lanes = static_cast<std::uint32_t>(hn::Lanes(d));
  const AxisOrder axes(slabs.axis);
  Vec3 corners[3];
  const bool is_triangle = geometry.corners(reference.primitive, corners);
  const SlabVector first_slab = InAllSlabs(static_cast<float>(first)), last_slab = InAllSlabs(static_cast<float>(last));
  for (std::uint32_t s = first / lanes * lanes; s <= last; s += lanes) {
    const SlabVector number = hn::Iota(d, static_cast<float>(s));
    const SlabVector begin = hn::IfThenElse(hn::Eq(number, first_slab), InAllSlabs(reference.lower[axes.divided]),
                                            hn::LoadU(d, slabs.borders.data() + s));
    const SlabVector end = hn::IfThenElse(hn::Eq(number, last_slab), InAllSlabs(reference.upper[axes.divided]),
                                          hn::LoadU(d, slabs.borders.data() + s + 1));
    SlabMask there = hn::And(hn::Ge(number, first_slab), hn::Le(number, last_slab));
    PartRange ranges[2];
    for (PartRange& range : ranges) range.Clear();
    for (std::size_t c = 0; c < 3 && is_triangle; ++c) {
      AddEdge(corners[c], corners[(c + 1) % 3], axes, begin, end, ranges);
    }
    for (std::size_t i = 0; i < 2; ++i) {
      const float least = reference.lower[axes.others[i]], most = reference.upper[axes.others[i]];
      if (is_triangle) {
        ranges[i].Limit(least, most);
      } else {
        ranges[i].lower = InAllSlabs(least);
        ranges[i].upper = InAllSlabs(most);
      }
      there = hn::And(there, hn::Le(ranges[i].lower, ranges[i].upper));
    }
    planes.Grow(axes.divided, s, begin, end, there);
    for (std::size_t i = 0; i < 2; ++i) planes.Grow(axes.others[i], s, ranges[i].lower, ranges[i].upper, there);
  }
}

void FillSlabs(std::span<const Reference> references, const Geometry& geometry, const SlabAxis& slabs,
               SlabContents& out) {
  std::fill_n(out.boxes.begin(), slabs.slabs, Box4{});
  std::fill_n(out.begin.begin(), slabs.slabs, 0u);
  std::fill_n(out.end.begin(), slabs.slabs, 0u);
  SlabPlanes planes;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    std::fill_n(planes.lower[axis], slabs.slabs + slab_padding, Box4::infinity);
    std::fill_n(planes.upper[axis], slabs.slabs + slab_padding, -Box4::infinity);
  }
  const auto axis = static_cast<std::size_t>(slabs.axis);
  for (const Reference& reference : references) {
    const std::uint32_t first = slabs.slab(reference.lower[axis]), last = slabs.slab(reference.upper[axis]);
    ++out.begin[first];
    ++out.end[last];
    if (first == last) {
      out.boxes[first].grow(box4(reference));
    } else {
      AddParts(reference, geometry, slabs, first, last, planes);
    }
  }
  for (std::size_t s = 0; s < slabs.slabs; ++s) {
    Box4 parts;
    for (std::size_t a = 0; a < 3; ++a) {
      parts.lower[static_cast<int>(a)] = planes.lower[a][s];
      parts.upper[static_cast<int>(a)] = planes.upper[a][s];
    }
    out.boxes[s].grow(parts);
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace boxwood
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace boxwood {

HWY_EXPORT(FillSlabs);

void fill_slabs(std::span<const Reference> references, const Geometry& geometry, const SlabAxis& slabs,
                SlabContents& out) {
  HWY_DYNAMIC_DISPATCH(FillSlabs)(references, geometry, slabs, out);
}

}  // namespace boxwood
#endif
