// One ray at a time: nearest child first, the others on a stack with their distances.
#if defined(BOXWOOD_LAYOUT_SIMD_SINGLE_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef BOXWOOD_LAYOUT_SIMD_SINGLE_INL_H
#undef BOXWOOD_LAYOUT_SIMD_SINGLE_INL_H
#else
#define BOXWOOD_LAYOUT_SIMD_SINGLE_INL_H
#endif

#include <bit>
#include <utility>

#include "boxwood/counters.h"
#include "layout/simd/boxes-inl.h"
#include "layout/simd/store-inl.h"
#include "layout/simd/triangles-inl.h"
#include "layout/simd/wide_arena.h"

HWY_BEFORE_NAMESPACE();
namespace boxwood {
namespace HWY_NAMESPACE {

/// Counting policies: the timed kernels carry no trace of the first.
struct CountNothing {
  template <int N>
  void node(const WideNode<N>&, std::uint32_t) {}
  void leaf() {}
  template <int L>
  void block(const LeafBlock<L>&) {}
};

struct CountSteps {
  RayCounters& counters;

  template <int N>
  void node(const WideNode<N>& node, std::uint32_t hits) {
    ++counters.steps;
    for (const WideReference child : node.children) counters.node_tests += child != wide_nothing ? 1 : 0;
    counters.node_hits += static_cast<std::uint32_t>(std::popcount(hits));
  }
  void leaf() { ++counters.leaves; }
  template <int L>
  void block(const LeafBlock<L>& block) {
    // Missing triangles are points: the first two vertices are the same.
    for (int lane = 0; lane < L; ++lane) {
      bool point = true;
      for (int axis = 0; axis < 3; ++axis) {
        point &= block.vertices[0][axis][lane] == block.vertices[1][axis][lane] &&
                 block.vertices[0][axis][lane] == block.vertices[2][axis][lane];
      }
      counters.primitive_tests += point ? 0 : 1;
    }
  }
};

/// What a traversal remembers for later.
struct Postponed {
  float entry;
  WideReference child;
};

/// Closest hit among the triangles of one block; true when it replaced `best`.
template <int L>
HWY_INLINE bool closest_in_block(const LeafBlock<L>& block, const TriangleRay& ray, float t_near, float t_limit,
                                 Hit& best) {
  using D = Floats<L>;
  const D d;
  const ShearedRays<D> sheared = broadcast_sheared(d, ray);
  bool replaced = false;
  for (int begin = 0; begin < L; begin += lanes_of<D>) {
    const Vertices<D> triangle[3] = {load_vertices(d, block, 0, begin, ray.axes),
                                     load_vertices(d, block, 1, begin, ray.axes),
                                     load_vertices(d, block, 2, begin, ray.axes)};
    const TriangleHits<D> hits = hit_triangles(d, triangle, sheared);
    const auto in_range = hn::And(hn::Ge(hits.t, hn::Set(d, t_near)), hn::Le(hits.t, hn::Set(d, t_limit)));
    std::uint32_t bits = bits_of(d, hn::And(hits.hit, in_range));
    if (HWY_LIKELY(bits == 0)) continue;
    StoredHits<D> stored;
    stored.store(hits);
    for (; bits != 0; bits &= bits - 1) {
      const int lane = std::countr_zero(bits);
      const std::uint32_t primitive = block.primitives[begin + lane] & ~more_blocks;
      if (!wins(stored.t[lane], 0, primitive, best)) continue;
      best = stored.hit(lane, primitive, 0);
      replaced = true;
    }
  }
  return replaced;
}

template <int L>
HWY_INLINE bool any_in_block(const LeafBlock<L>& block, const TriangleRay& ray, float t_near, float t_far) {
  using D = Floats<L>;
  const D d;
  const ShearedRays<D> sheared = broadcast_sheared(d, ray);
  for (int begin = 0; begin < L; begin += lanes_of<D>) {
    const Vertices<D> triangle[3] = {load_vertices(d, block, 0, begin, ray.axes),
                                     load_vertices(d, block, 1, begin, ray.axes),
                                     load_vertices(d, block, 2, begin, ray.axes)};
    const TriangleHits<D> hits = hit_triangles(d, triangle, sheared);
    const auto in_range = hn::And(hn::Ge(hits.t, hn::Set(d, t_near)), hn::Le(hits.t, hn::Set(d, t_far)));
    if (bits_of(d, hn::And(hits.hit, in_range)) != 0) return true;
  }
  return false;
}

/// Which children the ray meets, one bit each; their distances go to entry[N].
template <int N, class D>
HWY_INLINE std::uint32_t hit_children(const WideNode<N>& node, const SlabRay<D>& slabs, float t_limit, float* entry) {
  const D d;
  std::uint32_t bits = 0;
  for (int begin = 0; begin < N; begin += lanes_of<D>) {
    const BoxHits<D> hits = hit_boxes(d, node, begin, slabs, hn::Set(d, t_limit));
    hn::Store(hits.entry, d, entry + begin);
    bits |= bits_of(d, hits.hit) << begin;
  }
  return bits;
}

/// Pushes the children in `bits` so that the nearest ends on top.
template <int N>
HWY_INLINE Postponed* push_sorted(const WideNode<N>& node, std::uint32_t bits, const float* entry, Postponed* top) {
  Postponed* const bottom = top;
  for (; bits != 0; bits &= bits - 1) {
    const int lane = std::countr_zero(bits);
    const Postponed next{entry[lane], node.children[lane]};
    Postponed* place = top++;
    for (; place != bottom && place[-1].entry < next.entry; --place) *place = place[-1];
    *place = next;
  }
  return top;
}

/// The next node or leaf for the ray after meeting `bits` of this node's children; `current` only changes when bits is
/// not 0. Cases by how often they happen: one, two, more.
template <class Store, int N>
HWY_INLINE Postponed* descend(const WideView& view, const WideNode<N>& node, std::uint32_t bits, const float* entry,
                              Postponed* top, WideReference& current) {
  const int first = std::countr_zero(bits);
  bits &= bits - 1;
  current = node.children[first];
  if (view.out_of_cache) Store::prefetch(view, current);
  if (HWY_LIKELY(bits == 0)) return top;
  const int second = std::countr_zero(bits);
  bits &= bits - 1;
  const WideReference other = node.children[second];
  if (view.out_of_cache) Store::prefetch(view, other);
  if (HWY_LIKELY(bits == 0)) {
    const bool swap = entry[second] < entry[first];
    *top = {swap ? entry[first] : entry[second], swap ? current : other};
    current = swap ? other : current;
    return top + 1;
  }
  top = push_sorted(node, bits | 1u << first | 1u << second, entry, top) - 1;
  current = top->child;
  return top;
}

template <class Store, class Count>
HWY_INLINE Hit closest_hit(const WideView& view, const PreparedRay& ray, Count count) {
  constexpr int N = Store::children;
  using D = Floats<N>;
  typename Store::NodeBuffer node_buffer;
  typename Store::BlockBuffer block_buffer;
  Hit best;
  if (!ray.valid) return best;
  const SlabRay<D> slabs = broadcast_slabs(D(), ray);
  const TriangleRay leaf_ray = triangle_ray(ray);
  Postponed stack[wide_stack_limit];
  Postponed* top = stack;
  float t_limit = ray.t_far;
  WideReference current = view.root;
  alignas(64) float entry[N];
  while (true) {
    while (!is_leaf(current)) {
      const WideNode<N>& node = Store::node(view, current, node_buffer);
      const std::uint32_t bits = hit_children<N>(node, slabs, t_limit, entry);
      count.node(node, bits);
      current = wide_finished;
      if (bits == 0) break;
      top = descend<Store>(view, node, bits, entry, top, current);
    }
    if (current != wide_finished) {
      count.leaf();
      bool more = true;
      for (std::size_t i = 0; more; ++i) {
        const auto& block = Store::block(view, current, i, block_buffer);
        count.block(block);
        if (closest_in_block(block, leaf_ray, ray.t_near, t_limit, best)) t_limit = best.t;
        more = (block.primitives[0] & more_blocks) != 0;
      }
    }
    do {
      if (top == stack) return best;
      --top;
    } while (!(top->entry <= t_limit));
    current = top->child;
  }
}

template <class Store, class Count>
HWY_INLINE bool any_hit(const WideView& view, const PreparedRay& ray, Count count) {
  constexpr int N = Store::children;
  using D = Floats<N>;
  typename Store::NodeBuffer node_buffer;
  typename Store::BlockBuffer block_buffer;
  if (!ray.valid) return false;
  const SlabRay<D> slabs = broadcast_slabs(D(), ray);
  const TriangleRay leaf_ray = triangle_ray(ray);
  WideReference stack[wide_stack_limit];
  WideReference* top = stack;
  WideReference current = view.root;
  alignas(64) float entry[N];
  while (true) {
    if (is_leaf(current)) {
      count.leaf();
      bool more = true;
      for (std::size_t i = 0; more; ++i) {
        const auto& block = Store::block(view, current, i, block_buffer);
        count.block(block);
        if (any_in_block(block, leaf_ray, ray.t_near, ray.t_far)) return true;
        more = (block.primitives[0] & more_blocks) != 0;
      }
    } else {
      const WideNode<N>& node = Store::node(view, current, node_buffer);
      std::uint32_t bits = hit_children<N>(node, slabs, ray.t_far, entry);
      count.node(node, bits);
      for (; bits != 0; bits &= bits - 1) {
        const WideReference child = node.children[std::countr_zero(bits)];
        if (view.out_of_cache) Store::prefetch(view, child);
        *top++ = child;
      }
    }
    if (top == stack) return false;
    current = *--top;
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace boxwood
HWY_AFTER_NAMESPACE();
#endif
