// Leaves of a coherent group: which triangles some ray of it may hit is found for a whole block at once, by intervals
// that hold all rays; what is left meets registers of rays, or few rays several triangles at a time. Compiled once per
// instruction set that has eight lanes.
#if defined(BOXWOOD_LAYOUT_SIMD_GROUP_LEAF_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef BOXWOOD_LAYOUT_SIMD_GROUP_LEAF_INL_H
#undef BOXWOOD_LAYOUT_SIMD_GROUP_LEAF_INL_H
#else
#define BOXWOOD_LAYOUT_SIMD_GROUP_LEAF_INL_H
#endif

#include <bit>

#include "layout/simd/ray_group-inl.h"
#include "layout/simd/triangles-inl.h"

HWY_BEFORE_NAMESPACE();
namespace boxwood {
namespace HWY_NAMESPACE {
#if HWY_MAX_BYTES >= 32

/// Rays of a group, a bit each.
struct Concerned {
  std::uint64_t rays = 0;

  /// The registers that they are in, a bit each.
  HWY_INLINE std::uint32_t registers() const {
    constexpr std::uint64_t in_first = (std::uint64_t{1} << group_lanes) - 1;
    std::uint32_t out = 0;
    for (int g = 0; g < group_vectors; ++g) {
      out |= static_cast<std::uint32_t>((rays >> (g * group_lanes) & in_first) != 0) << g;
    }
    return out;
  }
};

/// Where a group's rays see the corners of L triangles, each as a place and how far from it any ray may see it. Two
/// coordinates across the rays, as in the triangle test: a triangle that lies on one side of all rays in one of them is
/// hit by none. The error covers the rounding of the triangle test.
template <int L>
class GroupView {
  using D = Floats<L>;
  using V = hn::Vec<D>;

 public:
  explicit GroupView(const RayGroup& group) : kx_(group.kx), ky_(group.ky), kz_(group.kz) {
    const D d;
    const Interval x(group.least_origin[kx_], group.largest_origin[kx_]);
    const Interval y(group.least_origin[ky_], group.largest_origin[ky_]);
    const Interval z(group.least_origin[kz_], group.largest_origin[kz_]);
    const Interval across_x(group.least_shear[0], group.largest_shear[0]);
    const Interval across_y(group.least_shear[1], group.largest_shear[1]);
    origin_x_ = hn::Set(d, x.middle), origin_y_ = hn::Set(d, y.middle), origin_z_ = hn::Set(d, z.middle);
    shear_x_ = hn::Set(d, across_x.middle), shear_y_ = hn::Set(d, across_y.middle);
    spread_x_ = hn::Set(d, across_x.radius), spread_y_ = hn::Set(d, across_y.radius);
    const auto radius = [&](const Interval& origin, const Interval& shear) HWY_ATTR {
      return hn::Set(d, origin.radius + (std::fabs(shear.middle) + shear.radius) * z.radius + group.error);
    };
    radius_x_ = radius(x, across_x), radius_y_ = radius(y, across_y);
  }

  /// Triangles of a block that some ray may hit, a bit each. Those that only fill it are left out.
  HWY_INLINE std::uint32_t may_hit(const LeafBlock<L>& block) const {
    std::uint32_t bits = 0;
    for (int begin = 0; begin < L; begin += lanes_of<D>) bits |= may_hit(block, begin) << begin;
    return bits;
  }

 private:
  struct Interval {
    float middle, radius;

    Interval(float least, float largest)
        : middle(0.5f * (least + largest)), radius(std::max(largest - middle, middle - least)) {}
  };

  HWY_INLINE std::uint32_t may_hit(const LeafBlock<L>& block, int begin) const {
    const D d;
    const hn::RebindToUnsigned<D> words;
    V least_x, most_x, least_y, most_y;
    for (int corner = 0; corner < 3; ++corner) {
      const V z = hn::Sub(hn::Load(d, block.vertices[corner][kz_] + begin), origin_z_);
      const V x = hn::NegMulAdd(shear_x_, z, hn::Sub(hn::Load(d, block.vertices[corner][kx_] + begin), origin_x_));
      const V y = hn::NegMulAdd(shear_y_, z, hn::Sub(hn::Load(d, block.vertices[corner][ky_] + begin), origin_y_));
      const V far = hn::Abs(z);
      const V reach_x = hn::MulAdd(spread_x_, far, radius_x_), reach_y = hn::MulAdd(spread_y_, far, radius_y_);
      const V from_x = hn::Sub(x, reach_x), to_x = hn::Add(x, reach_x);
      const V from_y = hn::Sub(y, reach_y), to_y = hn::Add(y, reach_y);
      least_x = corner == 0 ? from_x : hn::Min(least_x, from_x), most_x = corner == 0 ? to_x : hn::Max(most_x, to_x);
      least_y = corner == 0 ? from_y : hn::Min(least_y, from_y), most_y = corner == 0 ? to_y : hn::Max(most_y, to_y);
    }
    const V zero = hn::Zero(d);
    const auto around = hn::And(hn::And(hn::Le(least_x, zero), hn::Ge(most_x, zero)),
                                hn::And(hn::Le(least_y, zero), hn::Ge(most_y, zero)));
    const auto first = hn::Set(words, block.primitives[0] & ~more_blocks);
    const std::uint32_t filling =
        bits_of(words, hn::Eq(hn::Load(words, block.primitives + begin), first)) & ~(begin == 0 ? 1u : 0u);
    return bits_of(d, around) & ~filling;
  }

  int kx_, ky_, kz_;
  V origin_x_, origin_y_, origin_z_, shear_x_, shear_y_, spread_x_, spread_y_, radius_x_, radius_y_;
};

/// One triangle of a block in every lane, its axes in the group's order.
template <int L>
HWY_INLINE void spread_triangle(const LeafBlock<L>& block, int lane, const RayGroup& group,
                                Vertices<GroupLanes> (&triangle)[3]) {
  const GroupLanes d;
  for (int v = 0; v < 3; ++v) {
    const auto& rows = block.vertices[v];
    triangle[v] = {hn::Set(d, rows[group.kx][lane]), hn::Set(d, rows[group.ky][lane]),
                   hn::Set(d, rows[group.kz][lane])};
  }
}

/// Triangles against rays of a group: hits within the range of t of each. of(values): those of the rays, a ray per
/// lane.
template <class D, class Of>
HWY_INLINE TriangleHits<D> hit_rays_of(D d, const Vertices<D> (&triangle)[3], const RayGroup& group, Of of) {
  const ShearedRays<D> rays{of(group.origin[group.kx]), of(group.origin[group.ky]), of(group.origin[group.kz]),
                            of(group.shear_x),          of(group.shear_y),          of(group.scale_z())};
  TriangleHits<D> hits = hit_triangles(d, triangle, rays);
  hits.hit = hn::And(hits.hit, hn::And(hn::Ge(hits.t, of(group.t_near)), hn::Le(hits.t, of(group.t_limit))));
  return hits;
}

/// One triangle against a register of rays.
template <class D>
HWY_INLINE TriangleHits<D> hit_by_register(D d, const Vertices<D> (&triangle)[3], const RayGroup& group, int g) {
  return hit_rays_of(d, triangle, group,
                     [&](const GroupFloats& values) HWY_ATTR { return hn::Load(d, values.lanes[g]); });
}

/// As many rays as there is room for in a register beside each other, each against all L triangles of a block.
template <int L>
class FewRays {
 public:
  using D = GroupLanes;
  static constexpr int together = group_lanes / L;

  HWY_INLINE FewRays(const LeafBlock<L>& block, const RayGroup& group) : group_(group) {
    const int axes[3] = {group.kx, group.ky, group.kz};
    for (int v = 0; v < 3; ++v) {
      const auto row = [&](int axis) HWY_ATTR { return repeated(block.vertices[v][axes[axis]]); };
      triangles_[v] = {row(0), row(1), row(2)};
    }
  }

  /// Takes the first of `rays` away; lane L * i + k of the answer is the i-th of them and triangle k. When there are
  /// fewer, the last is there more than once.
  HWY_INLINE TriangleHits<D> hit_next(std::uint64_t& rays, int (&taken)[together]) const {
    for (int i = 0; i < together; ++i) {
      taken[i] = std::countr_zero(rays);
      if (i + 1 == together || (rays & (rays - 1)) != 0) rays &= rays - 1;
    }
    return hit_rays_of(D(), triangles_, group_,
                       [&](const GroupFloats& values) HWY_ATTR { return beside_each_other(values, taken); });
  }

 private:
  static HWY_INLINE hn::Vec<D> repeated(const float* row) {
    const D d;
    if constexpr (together == 1)
      return hn::Load(d, row);
    else if constexpr (L == 4)
      return hn::LoadDup128(d, row);
    else
      return hn::Combine(d, hn::Load(hn::Half<D>(), row), hn::Load(hn::Half<D>(), row));
  }
  static HWY_INLINE hn::Vec<D> beside_each_other(const GroupFloats& values, const int (&rays)[together]) {
    const D d;
    auto out = hn::Set(d, values.of(rays[together - 1]));
    for (int i = together - 2; i >= 0; --i) {
      out = hn::IfThenElse(hn::FirstN(d, static_cast<std::size_t>(L * (i + 1))), hn::Set(d, values.of(rays[i])), out);
    }
    return out;
  }

  const RayGroup& group_;
  Vertices<D> triangles_[3];
};

/// Closest hits of a group so far. A missing primitive counts as larger than any.
struct GroupHits {
  GroupFloats t, v, w, determinant;
  alignas(64) std::int32_t primitives[group_vectors][group_lanes];

  GroupHits() {
    std::ranges::fill_n(&t.lanes[0][0], group_size, std::numeric_limits<float>::infinity());
    std::ranges::fill_n(&primitives[0][0], group_size, std::numeric_limits<std::int32_t>::max());
  }
};

/// What a group finds out at a block: the closest hits. Both ways return true when a ray's limit came nearer.
struct ClosestOfGroup {
  /// What a group may cost, in node steps, before its rays are better off one by one. The steps that 64 rays in flight
  /// take together are some 15 to 25 times as many.
  static constexpr int budget = 640;
  static constexpr bool ordered = true;  ///< nearest children first

  RayGroup& group;
  GroupHits& best;

  template <int L>
  HWY_INLINE bool by_rays(const LeafBlock<L>& block, std::uint64_t rays) {
    using Few = FewRays<L>;
    const Few few(block, group);
    bool nearer = false;
    while (rays != 0) {
      int taken[Few::together];
      const auto hits = few.hit_next(rays, taken);
      std::uint32_t bits = bits_of(GroupLanes(), hits.hit);
      if (bits == 0) continue;
      StoredHits<GroupLanes> stored;
      stored.store(hits);
      for (; bits != 0; bits &= bits - 1) {
        const int lane = std::countr_zero(bits);
        nearer |= offer(taken[lane / L], block.primitives[lane % L] & ~more_blocks, stored, lane);
      }
    }
    return nearer;
  }

  template <int L>
  HWY_INLINE bool by_triangles(const LeafBlock<L>& block, std::uint32_t triangles, Concerned concerned) {
    bool nearer = false;
    for (; triangles != 0; triangles &= triangles - 1) {
      const int lane = std::countr_zero(triangles);
      Vertices<GroupLanes> triangle[3];
      spread_triangle(block, lane, group, triangle);
      for (std::uint32_t left = concerned.registers(); left != 0; left &= left - 1) {
        nearer |= offer(triangle, block.primitives[lane] & ~more_blocks, std::countr_zero(left));
      }
    }
    return nearer;
  }

 private:
  HWY_INLINE bool offer(int ray, std::uint32_t number, const StoredHits<GroupLanes>& hits, int lane) {
    std::int32_t& primitive = (&best.primitives[0][0])[ray];
    const float t = hits.t[lane];
    if (t > best.t.of(ray) || (t == best.t.of(ray) && static_cast<std::int32_t>(number) >= primitive)) return false;
    best.t.of(ray) = group.t_limit.of(ray) = t;
    best.v.of(ray) = hits.v[lane];
    best.w.of(ray) = hits.w[lane];
    best.determinant.of(ray) = hits.determinant[lane];
    primitive = static_cast<std::int32_t>(number);
    return true;
  }

  HWY_INLINE bool offer(const Vertices<GroupLanes> (&triangle)[3], std::uint32_t primitive, int g) {
    const GroupLanes d;
    const hn::RebindToSigned<GroupLanes> di;
    const auto hits = hit_by_register(d, triangle, group, g);
    if (HWY_LIKELY(hn::AllFalse(d, hits.hit))) return false;
    const auto number = hn::Set(di, static_cast<std::int32_t>(primitive));
    const auto best_t = hn::Load(d, best.t.lanes[g]);
    const auto best_primitive = hn::Load(di, best.primitives[g]);
    const auto smaller = hn::RebindMask(d, hn::Lt(number, best_primitive));
    const auto wins = hn::And(hits.hit, hn::Or(hn::Lt(hits.t, best_t), hn::And(hn::Eq(hits.t, best_t), smaller)));
    const auto keep = [&](GroupFloats& values, auto value) HWY_ATTR {
      hn::Store(hn::IfThenElse(wins, value, hn::Load(d, values.lanes[g])), d, values.lanes[g]);
    };
    keep(best.t, hits.t);
    keep(group.t_limit, hits.t);
    keep(best.v, hits.v);
    keep(best.w, hits.w);
    keep(best.determinant, hits.determinant);
    hn::Store(hn::IfThenElse(hn::RebindMask(di, wins), number, best_primitive), di, best.primitives[g]);
    return true;
  }
};

/// What a group finds out at a block: which rays are blocked. Such a ray gets a limit before its beginning and so meets
/// nothing more. Both ways return true when one was.
struct AnyOfGroup {
  static constexpr int budget = 160;      ///< less than for closest hits: a stream takes rays that share little
  static constexpr bool ordered = false;  ///< children as stored, the last first
  static constexpr float done = -std::numeric_limits<float>::infinity();

  RayGroup& group;

  template <int L>
  HWY_INLINE bool by_rays(const LeafBlock<L>& block, std::uint64_t rays) {
    using Few = FewRays<L>;
    const Few few(block, group);
    bool found = false;
    while (rays != 0) {
      int taken[Few::together];
      std::uint32_t bits = bits_of(GroupLanes(), few.hit_next(rays, taken).hit);
      found |= bits != 0;
      for (; bits != 0; bits &= bits - 1) group.t_limit.of(taken[std::countr_zero(bits) / L]) = done;
    }
    return found;
  }

  template <int L>
  HWY_INLINE bool by_triangles(const LeafBlock<L>& block, std::uint32_t triangles, Concerned concerned) {
    const GroupLanes d;
    bool found = false;
    for (; triangles != 0 && concerned.rays != 0; triangles &= triangles - 1) {
      Vertices<GroupLanes> triangle[3];
      spread_triangle(block, std::countr_zero(triangles), group, triangle);
      for (std::uint32_t left = concerned.registers(); left != 0; left &= left - 1) {
        const int g = std::countr_zero(left);
        const auto hit = hit_by_register(d, triangle, group, g).hit;
        if (HWY_LIKELY(hn::AllFalse(d, hit))) continue;
        hn::Store(hn::IfThenElse(hit, hn::Set(d, done), hn::Load(d, group.t_limit.lanes[g])), d,
                  group.t_limit.lanes[g]);
        concerned.rays &= ~(std::uint64_t{bits_of(d, hit)} << (g * group_lanes));
        found = true;
      }
    }
    return found;
  }
};

/// Up to this many rays per register are tested each on their own.
template <int L>
inline constexpr int few_per_register = 3 * FewRays<L>::together;

#endif  // HWY_MAX_BYTES >= 32
}  // namespace HWY_NAMESPACE
}  // namespace boxwood
HWY_AFTER_NAMESPACE();
#endif
