// Coherent rays in groups of 64: inner nodes are tested once for the whole group, by intervals that hold all its rays
// (after Overbeck, Ramamoorthi, Mark 2008, "Large Ray Packets for Real-time Whitted Ray Tracing"); at a leaf that the
// group may hit, registers of rays are tested against its box, and those that meet it against its triangles.
#if defined(BOXWOOD_LAYOUT_SIMD_PACKET_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef BOXWOOD_LAYOUT_SIMD_PACKET_INL_H
#undef BOXWOOD_LAYOUT_SIMD_PACKET_INL_H
#else
#define BOXWOOD_LAYOUT_SIMD_PACKET_INL_H
#endif

#include <bit>

#include "layout/simd/group_leaf-inl.h"
#include "layout/simd/ray_group-inl.h"
#include "layout/simd/wide_arena.h"

HWY_BEFORE_NAMESPACE();
namespace boxwood {
namespace HWY_NAMESPACE {
#if HWY_MAX_BYTES >= 32

/// A child of a node, met at `entry` or later by every ray of the group, and where its box is.
struct PostponedBox {
  float entry;
  WideReference child, parent;
  std::uint32_t lane;
};

/// The intervals of a group in every lane.
template <class D>
struct GroupSlabs {
  using V = hn::Vec<D>;
  V near_origin[3], far_origin[3], least_inverse[3], largest_inverse[3], slack[3], t_near;
  int near_row[3];

  explicit GroupSlabs(const RayGroup& group) {
    const D d;
    for (int axis = 0; axis < 3; ++axis) {
      const bool negative = group.negative[axis] != 0;
      near_origin[axis] = hn::Set(d, negative ? group.least_origin[axis] : group.largest_origin[axis]);
      far_origin[axis] = hn::Set(d, negative ? group.largest_origin[axis] : group.least_origin[axis]);
      least_inverse[axis] = hn::Set(d, group.least_inverse[axis]);
      largest_inverse[axis] = hn::Set(d, group.largest_inverse[axis]);
      slack[axis] = hn::Set(d, group.slack[axis]);
      near_row[axis] = 2 * axis + group.negative[axis];
    }
    t_near = hn::Set(d, group.least_t_near);
  }
};

/// Which children some ray of the group may meet before t_limit, and from where on.
template <int N, class D>
HWY_INLINE std::uint32_t hit_children(const WideNode<N>& node, int begin, const GroupSlabs<D>& slabs, float t_limit,
                                      float* entries) {
  const D d;
  auto entry = slabs.t_near;
  auto exit = hn::Set(d, t_limit);
  for (int axis = 0; axis < 3; ++axis) {
    const auto near_plane = hn::Sub(hn::Load(d, node.planes[slabs.near_row[axis]] + begin), slabs.near_origin[axis]);
    const auto far_plane = hn::Sub(hn::Load(d, node.planes[slabs.near_row[axis] ^ 1] + begin), slabs.far_origin[axis]);
    const auto from =
        hn::Min(hn::Mul(near_plane, slabs.least_inverse[axis]), hn::Mul(near_plane, slabs.largest_inverse[axis]));
    const auto to =
        hn::Max(hn::Mul(far_plane, slabs.least_inverse[axis]), hn::Mul(far_plane, slabs.largest_inverse[axis]));
    entry = hn::Max(hn::Sub(from, slabs.slack[axis]), entry);
    exit = hn::Min(hn::Add(to, slabs.slack[axis]), exit);
  }
  hn::Store(entry, d, entries + begin);
  return bits_of(d, hn::Le(entry, exit)) << begin;
}

/// The rays that meet the box.
template <class Store>
HWY_INLINE Concerned rays_in_box(const WideView& view, const RayGroup& group, const PostponedBox& box) {
  const GroupLanes d;
  hn::Vec<decltype(d)> near_plane[3], far_plane[3];
  for (int axis = 0; axis < 3; ++axis) {
    const int near_row = 2 * axis + group.negative[axis];
    near_plane[axis] = hn::Set(d, Store::plane(view, box.parent, near_row, box.lane));
    far_plane[axis] = hn::Set(d, Store::plane(view, box.parent, near_row ^ 1, box.lane));
  }
  Concerned out;
  for (int g = 0; g < group_vectors; ++g) {
    auto entry = hn::Load(d, group.t_near.lanes[g]);
    auto exit = hn::Load(d, group.t_limit.lanes[g]);
    for (int axis = 0; axis < 3; ++axis) {
      const auto inverse = hn::Load(d, group.inverse[axis].lanes[g]);
      entry = hn::Max(hn::MulSub(near_plane[axis], inverse, hn::Load(d, group.near_offset[axis].lanes[g])), entry);
      exit = hn::Min(hn::MulSub(far_plane[axis], inverse, hn::Load(d, group.far_offset[axis].lanes[g])), exit);
    }
    out.rays |= std::uint64_t{bits_of(d, hn::Le(entry, exit))} << (g * group_lanes);
  }
  return out;
}

/// The blocks of a leaf, one after the other: triangles that no ray of the group may hit are left out, and the rays
/// that meet the leaf's box are found when there is one that some may. True when limits changed.
template <class Store, class Find>
HWY_INLINE bool visit_leaf(const WideView& view, const RayGroup& group, const GroupView<Store::triangles>& group_view,
                           const PostponedBox& leaf, int& budget, Find& find) {
  constexpr int L = Store::triangles;
  typename Store::BlockBuffer buffer;
  Concerned concerned;
  bool looked = false, changed = false, more = true;
  for (std::size_t i = 0; more; ++i) {
    const auto& block = Store::block(view, leaf.child, i, buffer);
    more = (block.primitives[0] & more_blocks) != 0;
    --budget;
    const std::uint32_t triangles = group_view.may_hit(block);
    if (triangles == 0) continue;
    if (!looked) {
      concerned = rays_in_box<Store>(view, group, leaf);
      if (concerned.rays == 0) break;
      looked = true;
    }
    const int registers = std::popcount(concerned.registers());
    budget -= registers;
    if (std::popcount(concerned.rays) <= few_per_register<L> * registers)
      changed |= find.by_rays(block, concerned.rays);
    else
      changed |= find.by_triangles(block, triangles, concerned);
  }
  return changed;
}

/// Walks the tree for a group, children in the order that `find` wants, and lets it have the triangles that a ray may
/// meet. False when the budget ran out: the rays lie so far apart, for triangles of this size, that they share little,
/// and the walk is not complete.
template <class Store, class Find>
HWY_INLINE bool walk_group(const WideView& view, const RayGroup& group, Find find) {
  constexpr int N = Store::children;
  using D = Floats<N>;
  typename Store::NodeBuffer buffer;
  const GroupSlabs<D> slabs(group);
  const GroupView<Store::triangles> group_view(group);
  PostponedBox stack[wide_stack_limit];
  PostponedBox* top = stack;
  float t_limit = largest_of(group.t_limit);
  WideReference current = view.root;
  alignas(64) float entries[N];
  for (int budget = Find::budget; budget > 0; --budget) {
    const WideNode<N>& node = Store::node(view, current, buffer);
    std::uint32_t bits = 0;
    for (int begin = 0; begin < N; begin += lanes_of<D>) bits |= hit_children(node, begin, slabs, t_limit, entries);
    PostponedBox* const bottom = top;
    for (; bits != 0; bits &= bits - 1) {
      const int lane = std::countr_zero(bits);
      if (view.out_of_cache) Store::prefetch(view, node.children[lane]);
      const PostponedBox next{entries[lane], node.children[lane], current, static_cast<std::uint32_t>(lane)};
      PostponedBox* place = top++;
      if constexpr (Find::ordered)
        for (; place != bottom && place[-1].entry < next.entry; --place) *place = place[-1];
      *place = next;
    }
    while (true) {
      if (top == stack) return true;
      const PostponedBox next = *--top;
      if (!(next.entry <= t_limit)) continue;
      current = next.child;
      if (!is_leaf(current)) break;
      if (visit_leaf<Store>(view, group, group_view, next, budget, find)) t_limit = largest_of(group.t_limit);
    }
  }
  return false;
}

/// False when the group is not worth it; nothing is written then.
template <class Store>
HWY_NOINLINE bool closest_hits_of_group(const WideView& view, RayGroup& group, Hit* hits) {
  const GroupLanes d;
  GroupHits best;
  for (std::size_t i = 0; i < group_size; i += 64 / sizeof(Hit)) __builtin_prefetch(hits + i, 1);
  if (!walk_group<Store>(view, group, ClosestOfGroup{group, best})) return false;
  for (int g = 0; g < group_vectors; ++g) {
    const auto determinant = hn::Load(d, best.determinant.lanes[g]);
    alignas(64) float u[group_lanes], v[group_lanes];
    hn::Store(hn::Div(hn::Load(d, best.v.lanes[g]), determinant), d, u);
    hn::Store(hn::Div(hn::Load(d, best.w.lanes[g]), determinant), d, v);
    for (int lane = 0; lane < group_lanes; ++lane) {
      const std::int32_t primitive = best.primitives[g][lane];
      hits[group_lanes * g + lane] =
          primitive == std::numeric_limits<std::int32_t>::max()
              ? Hit{}
              : Hit{best.t.lanes[g][lane], u[lane], v[lane], static_cast<std::uint32_t>(primitive), 0};
    }
  }
  return true;
}

/// False when the group is not worth it; nothing is written then.
template <class Store>
HWY_NOINLINE bool any_hits_of_group(const WideView& view, RayGroup& group, std::uint8_t* blocked) {
  if (!walk_group<Store>(view, group, AnyOfGroup{group})) return false;
  for (std::size_t i = 0; i < group_size; ++i) {
    blocked[i] = (&group.t_limit.lanes[0][0])[i] < (&group.t_near.lanes[0][0])[i] ? 1 : 0;
  }
  return true;
}

#endif  // HWY_MAX_BYTES >= 32
}  // namespace HWY_NAMESPACE
}  // namespace boxwood
HWY_AFTER_NAMESPACE();
#endif
