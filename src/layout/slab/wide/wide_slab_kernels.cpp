#include "trace/scalar_targets.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "layout/slab/wide/wide_slab_kernels.cpp"
#include <hwy/foreach_target.h>
//
#include "layout/simd/lanes-inl.h"
#include "layout/slab/plane_rows-inl.h"
#include "layout/slab/wide/wide_slab_nodes.h"
#include "layout/walk-inl.h"

HWY_BEFORE_NAMESPACE();
namespace boxwood {
namespace HWY_NAMESPACE {

/// One child after the other.
class EachPlane {
 public:
  EachPlane(const WideSlabNodes& nodes, const PreparedRay& ray) : nodes_(nodes), rows_(ray) {}

  HWY_INLINE std::uint32_t test(const std::uint32_t* node, std::uint32_t children, Part part, Part* parts) const {
    std::uint32_t met = 0;
    for (std::uint32_t child = 0; child < children; ++child) {
      Part left = part;
      for (std::uint32_t plane = 0; plane < nodes_.planes; ++plane) {
        const std::uint32_t bits = node[plane * nodes_.k + child];
        left = rows_.narrow(std::bit_cast<float>(bits), bits & 7, left);
      }
      parts[child] = left;
      met |= left.empty() ? 0 : 1u << child;
    }
    return met;
  }

 private:
  const WideSlabNodes& nodes_;
  PlaneRows rows_;
};

#if HWY_MAX_BYTES >= 32
/// Eight children at a time: what the ray makes of each plane is looked up by the side in the plane's own bits.
template <std::uint32_t k>
class AllPlanes {
 public:
  AllPlanes(const WideSlabNodes& nodes, const PreparedRay& ray) : planes_(nodes.planes) {
    const PlaneRows rows(ray);
    alignas(32) float values[4][8];
    for (int side = 0; side < 8; ++side) {
      values[0][side] = rows.rows[side].near_inverse, values[1][side] = rows.rows[side].near_offset;
      values[2][side] = rows.rows[side].far_inverse, values[3][side] = rows.rows[side].far_offset;
    }
    for (int i = 0; i < 4; ++i) table_[i] = hn::Load(d, values[i]);
  }

  HWY_INLINE std::uint32_t test(const std::uint32_t* node, std::uint32_t, Part part, Part* parts) const {
    std::uint32_t met = 0;
    for (std::uint32_t begin = 0; begin < k; begin += 8) {
      auto from = hn::Set(d, part.from), exit = hn::Set(d, part.exit);
      for (std::uint32_t plane = 0; plane < planes_; ++plane) {
        const auto bits = hn::Load(du, node + plane * k + begin);
        const auto side = hn::IndicesFromVec(d, hn::And(bits, hn::Set(du, 7)));
        const auto value = hn::BitCast(d, bits);
        const auto t0 = hn::MulSub(value, hn::TableLookupLanes(table_[0], side), hn::TableLookupLanes(table_[1], side));
        const auto t1 = hn::MulSub(value, hn::TableLookupLanes(table_[2], side), hn::TableLookupLanes(table_[3], side));
        from = hn::Max(t0, from);
        exit = hn::Min(t1, exit);
      }
      V low, high;
      low = hn::InterleaveLower(d, from, exit), high = hn::InterleaveUpper(d, from, exit);
      float* out = &parts[begin].from;
      hn::Store(hn::ConcatLowerLower(d, high, low), d, out);
      hn::Store(hn::ConcatUpperUpper(d, high, low), d, out + 8);
      met |= bits_of(d, hn::Le(from, exit)) << begin;
    }
    return met;
  }

 private:
  static constexpr hn::FixedTag<float, 8> d{};
  static constexpr hn::FixedTag<std::uint32_t, 8> du{};
  using V = hn::Vec<hn::FixedTag<float, 8>>;
  V table_[4];
  std::uint32_t planes_;
};
#endif

/// A slot is the place of a child's word in memory.
template <class Planes>
class WideSlabTester {
 public:
  static constexpr bool segments = true, binary = false;
  static constexpr std::uint32_t most_children = 16;

  WideSlabTester(const WideSlabNodes& nodes, const PreparedRay& ray)
      : nodes_(nodes),
        memory_(nodes.memory.data()),
        stride_(nodes.stride()),
        children_offset_(nodes.k * nodes.planes),
        planes_(nodes, ray) {}

  const Box& root_box() const { return nodes_.root_box; }
  static std::uint32_t root_slot() { return 0; }
  const Link& root_link() const { return nodes_.root; }
  HWY_INLINE Link link(std::uint32_t slot) const { return nodes_.link_of({memory_[slot]}); }
  static std::uint32_t children(const Link& link) { return link.count; }
  HWY_INLINE std::uint32_t slot_of(std::uint32_t, const Link& link, std::uint32_t child) const {
    return link.first * stride_ + children_offset_ + child;
  }
  HWY_INLINE std::uint32_t test_all(std::uint32_t, const Link& link, Part part, float limit, Part* parts) const {
    part.exit = limit < part.exit ? limit : part.exit;
    return planes_.test(memory_ + std::size_t{link.first} * stride_, link.count, part, parts);
  }

 private:
  const WideSlabNodes& nodes_;
  const std::uint32_t* memory_;
  const std::uint32_t stride_, children_offset_;
  Planes planes_;
};

template <class Leaves>
Kernels<WideSlabNodes, Leaves> choose_wide_slab(const TraceOptions& options, std::uint32_t k) {
#if HWY_MAX_BYTES >= 32
  if (options.simd && k == 8) return choose_kernels<WideSlabTester<AllPlanes<8>>, WideSlabNodes, Leaves>(options);
  if (options.simd && k == 16) return choose_kernels<WideSlabTester<AllPlanes<16>>, WideSlabNodes, Leaves>(options);
#else
  (void)k;
#endif
  return choose_kernels<WideSlabTester<EachPlane>, WideSlabNodes, Leaves>(options);
}

Kernels<WideSlabNodes, TriangleLeaves> choose_wide_slab_over_triangles(const TraceOptions& options, std::uint32_t k) {
  return choose_wide_slab<TriangleLeaves>(options, k);
}

Kernels<WideSlabNodes, InstanceLeaves> choose_wide_slab_over_instances(const TraceOptions& options, std::uint32_t k) {
  return choose_wide_slab<InstanceLeaves>(options, k);
}

}  // namespace HWY_NAMESPACE
}  // namespace boxwood
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace boxwood {

HWY_EXPORT(choose_wide_slab_over_triangles);
HWY_EXPORT(choose_wide_slab_over_instances);

Kernels<WideSlabNodes, TriangleLeaves> wide_slab_triangle_kernels(const TraceOptions& options, std::uint32_t k) {
  return HWY_DYNAMIC_DISPATCH(choose_wide_slab_over_triangles)(options, k);
}

Kernels<WideSlabNodes, InstanceLeaves> wide_slab_instance_kernels(const TraceOptions& options, std::uint32_t k) {
  return HWY_DYNAMIC_DISPATCH(choose_wide_slab_over_instances)(options, k);
}

}  // namespace boxwood
#endif
