// Coherent rays in groups of 64: inner nodes are tested once for the whole group, by intervals that hold all its rays
// (after Overbeck, Ramamoorthi, Mark 2008, "Large Ray Packets for Real-time Whitted Ray Tracing"); at a leaf, registers
// of rays are tested against its box, and those that meet it against its triangles.
#if defined(BOXWOOD_LAYOUT_SIMD_PACKET_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef BOXWOOD_LAYOUT_SIMD_PACKET_INL_H
#undef BOXWOOD_LAYOUT_SIMD_PACKET_INL_H
#else
#define BOXWOOD_LAYOUT_SIMD_PACKET_INL_H
#endif

#include <bit>

#include "layout/simd/ray_group-inl.h"
#include "layout/simd/triangles-inl.h"
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

/// Which rays of a group are concerned: a bit per register that holds one, and a bit per ray.
struct Concerned {
  std::uint32_t registers = 0;
  std::uint64_t rays = 0;
};

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
    const std::uint64_t met = bits_of(d, hn::Le(entry, exit));
    out.registers |= static_cast<std::uint32_t>(met != 0) << g;
    out.rays |= met << (g * group_lanes);
  }
  return out;
}

/// One triangle against a register of rays: hits within the range of t of each.
template <class D>
HWY_INLINE TriangleHits<D> hit_by_register(D d, const Vertices<D> (&triangle)[3], const RayGroup& group, int g) {
  const auto of = [&](const GroupFloats& values) { return hn::Load(d, values.lanes[g]); };
  const ShearedRays<D> rays{of(group.origin[group.kx]), of(group.origin[group.ky]), of(group.origin[group.kz]),
                            of(group.shear_x),          of(group.shear_y),          of(group.scale_z)};
  TriangleHits<D> hits = hit_triangles(d, triangle, rays);
  hits.hit = hn::And(hits.hit, hn::And(hn::Ge(hits.t, of(group.t_near)), hn::Le(hits.t, of(group.t_limit))));
  return hits;
}

/// Calls visit(triangle, primitive) for each triangle of a leaf, its vertices in every lane.
template <class Store, class Visit>
HWY_INLINE void for_each_triangle(const WideView& view, WideReference leaf, const RayGroup& group, Visit visit) {
  using D = GroupLanes;
  const D d;
  typename Store::BlockBuffer buffer;
  bool more = true;
  for (std::size_t i = 0; more; ++i) {
    const auto& block = Store::block(view, leaf, i, buffer);
    more = (block.primitives[0] & more_blocks) != 0;
    const std::uint32_t first = block.primitives[0] & ~more_blocks;
    for (int lane = 0; lane < Store::triangles; ++lane) {
      const std::uint32_t primitive = block.primitives[lane] & ~more_blocks;
      if (lane > 0 && primitive == first) break;  // the rest are points that fill the block
      const auto vertex = [&](int v) {
        return Vertices<D>{hn::Set(d, block.vertices[v][group.kx][lane]), hn::Set(d, block.vertices[v][group.ky][lane]),
                           hn::Set(d, block.vertices[v][group.kz][lane])};
      };
      const Vertices<D> triangle[3] = {vertex(0), vertex(1), vertex(2)};
      visit(triangle, primitive);
    }
  }
}

/// Closest hits so far. A missing primitive counts as larger than any.
struct GroupHits {
  GroupFloats t, v, w, determinant;
  alignas(64) std::int32_t primitives[group_vectors][group_lanes];

  GroupHits() {
    std::ranges::fill_n(&t.lanes[0][0], group_size, std::numeric_limits<float>::infinity());
    std::ranges::fill_n(&primitives[0][0], group_size, std::numeric_limits<std::int32_t>::max());
  }
};

/// Where few rays of a group meet a leaf, each is tested against all triangles of a block at once, instead of each
/// triangle against registers of rays.
inline constexpr int few_per_register = 3;
HWY_INLINE bool are_few(const Concerned& concerned) {
  return std::popcount(concerned.rays) <= few_per_register * std::popcount(concerned.registers);
}

/// Calls visit(ray, first lane, block, hits) for each ray and each register of triangles of a leaf: the hits within the
/// ray's range, that of the group at the time.
template <class Store, class Visit>
HWY_INLINE void for_each_ray(const WideView& view, WideReference leaf, std::uint64_t rays, const RayGroup& group,
                             Visit visit) {
  using D = Floats<Store::triangles>;
  const D d;
  const std::uint32_t axes[3] = {static_cast<std::uint32_t>(group.kx), static_cast<std::uint32_t>(group.ky),
                                 static_cast<std::uint32_t>(group.kz)};
  typename Store::BlockBuffer buffer;
  bool more = true;
  for (std::size_t number = 0; more; ++number) {
    const auto& block = Store::block(view, leaf, number, buffer);
    more = (block.primitives[0] & more_blocks) != 0;
    for (int begin = 0; begin < Store::triangles; begin += lanes_of<D>) {
      const Vertices<D> triangle[3] = {load_vertices(d, block, 0, begin, axes), load_vertices(d, block, 1, begin, axes),
                                       load_vertices(d, block, 2, begin, axes)};
      for (std::uint64_t left = rays; left != 0; left &= left - 1) {
        const int ray = std::countr_zero(left);
        const auto of = [&](const GroupFloats& values) HWY_ATTR { return hn::Set(d, values.of(ray)); };
        const ShearedRays<D> sheared{of(group.origin[group.kx]), of(group.origin[group.ky]), of(group.origin[group.kz]),
                                     of(group.shear_x),          of(group.shear_y),          of(group.scale_z)};
        TriangleHits<D> hits = hit_triangles(d, triangle, sheared);
        hits.hit = hn::And(hits.hit, hn::And(hn::Ge(hits.t, of(group.t_near)), hn::Le(hits.t, of(group.t_limit))));
        if (!hn::AllFalse(d, hits.hit)) visit(ray, begin, block, hits);
      }
    }
  }
}

/// closest_in_leaf() ray by ray.
template <class Store>
HWY_INLINE bool closest_of_few(const WideView& view, WideReference leaf, std::uint64_t rays, RayGroup& group,
                               GroupHits& best) {
  using D = Floats<Store::triangles>;
  bool nearer = false;
  for_each_ray<Store>(view, leaf, rays, group, [&](int ray, int begin, const auto& block, const auto& hits) HWY_ATTR {
    StoredHits<D> stored;
    stored.store(hits);
    std::int32_t& primitive = (&best.primitives[0][0])[ray];
    for (std::uint32_t bits = bits_of(D(), hits.hit); bits != 0; bits &= bits - 1) {
      const int lane = std::countr_zero(bits);
      const auto number = static_cast<std::int32_t>(block.primitives[begin + lane] & ~more_blocks);
      const float t = stored.t[lane];
      if (t > best.t.of(ray) || (t == best.t.of(ray) && number >= primitive)) continue;
      best.t.of(ray) = group.t_limit.of(ray) = t;
      best.v.of(ray) = stored.v[lane];
      best.w.of(ray) = stored.w[lane];
      best.determinant.of(ray) = stored.determinant[lane];
      primitive = number;
      nearer = true;
    }
  });
  return nearer;
}

/// True when a ray's limit came nearer.
template <class Store>
HWY_INLINE bool closest_in_leaf(const WideView& view, WideReference leaf, std::uint32_t registers, RayGroup& group,
                                GroupHits& best) {
  const GroupLanes d;
  const hn::RebindToSigned<GroupLanes> di;
  bool nearer = false;
  for_each_triangle<Store>(view, leaf, group, [&](const auto& triangle, std::uint32_t primitive) HWY_ATTR {
    const auto number = hn::Set(di, static_cast<std::int32_t>(primitive));
    for (std::uint32_t left = registers; left != 0; left &= left - 1) {
      const int g = std::countr_zero(left);
      const auto hits = hit_by_register(d, triangle, group, g);
      if (HWY_LIKELY(hn::AllFalse(d, hits.hit))) continue;
      const auto best_t = hn::Load(d, best.t.lanes[g]);
      const auto best_primitive = hn::Load(di, best.primitives[g]);
      const auto smaller = hn::RebindMask(d, hn::Lt(number, best_primitive));
      const auto wins = hn::And(hits.hit, hn::Or(hn::Lt(hits.t, best_t), hn::And(hn::Eq(hits.t, best_t), smaller)));
      const auto keep = [&](GroupFloats& values, auto value) {
        hn::Store(hn::IfThenElse(wins, value, hn::Load(d, values.lanes[g])), d, values.lanes[g]);
      };
      keep(best.t, hits.t);
      keep(group.t_limit, hits.t);
      keep(best.v, hits.v);
      keep(best.w, hits.w);
      keep(best.determinant, hits.determinant);
      hn::Store(hn::IfThenElse(hn::RebindMask(di, wins), number, best_primitive), di, best.primitives[g]);
      nearer = true;
    }
  });
  return nearer;
}

/// any_in_leaf() ray by ray.
template <class Store>
HWY_INLINE bool any_of_few(const WideView& view, WideReference leaf, std::uint64_t rays, RayGroup& group) {
  bool found = false;
  for_each_ray<Store>(view, leaf, rays, group, [&](int ray, int, const auto&, const auto&) HWY_ATTR {
    group.t_limit.of(ray) = -std::numeric_limits<float>::infinity();
    found = true;
  });
  return found;
}

/// A ray that is blocked gets a limit before its beginning and so meets nothing more. True when one was.
template <class Store>
HWY_INLINE bool any_in_leaf(const WideView& view, WideReference leaf, std::uint32_t registers, RayGroup& group) {
  const GroupLanes d;
  bool found = false;
  for_each_triangle<Store>(view, leaf, group, [&](const auto& triangle, std::uint32_t) HWY_ATTR {
    for (std::uint32_t left = registers; left != 0; left &= left - 1) {
      const int g = std::countr_zero(left);
      const auto hits = hit_by_register(d, triangle, group, g);
      if (HWY_LIKELY(hn::AllFalse(d, hits.hit))) continue;
      const auto done = hn::Set(d, -std::numeric_limits<float>::infinity());
      hn::Store(hn::IfThenElse(hits.hit, done, hn::Load(d, group.t_limit.lanes[g])), d, group.t_limit.lanes[g]);
      found = true;
    }
  });
  return found;
}

/// What a group may cost, in node steps, before its rays are better off one by one. The steps that 64 rays in flight
/// take together are some 15 to 25 times as many.
inline constexpr int group_budget = 640;

/// Walks the tree for a group, nearest children first; at each leaf that a ray may meet calls
/// at_leaf(leaf, concerned), which returns true when limits changed. False when the budget ran out: the rays lie so
/// far apart, for triangles of this size, that they share little, and the walk is not complete.
template <class Store, class AtLeaf>
HWY_INLINE bool walk_group(const WideView& view, const RayGroup& group, AtLeaf at_leaf) {
  constexpr int N = Store::children;
  using D = Floats<N>;
  typename Store::NodeBuffer buffer;
  const GroupSlabs<D> slabs(group);
  PostponedBox stack[wide_stack_limit];
  PostponedBox* top = stack;
  float t_limit = largest_of(group.t_limit);
  WideReference current = view.root;
  alignas(64) float entries[N];
  for (int budget = group_budget; budget > 0; --budget) {
    const WideNode<N>& node = Store::node(view, current, buffer);
    std::uint32_t bits = 0;
    for (int begin = 0; begin < N; begin += lanes_of<D>) bits |= hit_children(node, begin, slabs, t_limit, entries);
    PostponedBox* const bottom = top;
    for (; bits != 0; bits &= bits - 1) {
      const int lane = std::countr_zero(bits);
      const PostponedBox next{entries[lane], node.children[lane], current, static_cast<std::uint32_t>(lane)};
      PostponedBox* place = top++;
      for (; place != bottom && place[-1].entry < next.entry; --place) *place = place[-1];
      *place = next;
    }
    while (true) {
      if (top == stack) return true;
      const PostponedBox next = *--top;
      if (!(next.entry <= t_limit)) continue;
      current = next.child;
      if (!is_leaf(current)) break;
      const Concerned concerned = rays_in_box<Store>(view, group, next);
      budget -= 2 + std::popcount(concerned.registers);
      if (concerned.rays == 0) continue;
      if (at_leaf(current, concerned)) t_limit = largest_of(group.t_limit);
    }
  }
  return false;
}

/// False when the group is not worth it; nothing is written then.
template <class Store>
HWY_NOINLINE bool closest_hits_of_group(const WideView& view, RayGroup& group, Hit* hits) {
  const GroupLanes d;
  GroupHits best;
  const auto at_leaf = [&](WideReference leaf, const Concerned& concerned) HWY_ATTR {
    if (are_few(concerned)) return closest_of_few<Store>(view, leaf, concerned.rays, group, best);
    return closest_in_leaf<Store>(view, leaf, concerned.registers, group, best);
  };
  if (!walk_group<Store>(view, group, at_leaf)) return false;
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
  const auto at_leaf = [&](WideReference leaf, const Concerned& concerned) HWY_ATTR {
    if (are_few(concerned)) return any_of_few<Store>(view, leaf, concerned.rays, group);
    return any_in_leaf<Store>(view, leaf, concerned.registers, group);
  };
  if (!walk_group<Store>(view, group, at_leaf)) return false;
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
