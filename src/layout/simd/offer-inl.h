// All hits of one ray, brought to a sink. Compiled once per instruction set.
#if defined(BOXWOOD_LAYOUT_SIMD_OFFER_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef BOXWOOD_LAYOUT_SIMD_OFFER_INL_H
#undef BOXWOOD_LAYOUT_SIMD_OFFER_INL_H
#else
#define BOXWOOD_LAYOUT_SIMD_OFFER_INL_H
#endif

#include "layout/simd/single-inl.h"
#include "trace/hit_sink.h"

HWY_BEFORE_NAMESPACE();
namespace boxwood {
namespace HWY_NAMESPACE {

/// Brings the hits among the triangles of one block to `sink`.
template <int L>
HWY_INLINE void offer_block(const LeafBlock<L>& block, const TriangleRay& ray, const PreparedRay& range,
                            std::uint32_t instance, HitSink& sink) {
  using D = Floats<L>;
  const D d;
  const ShearedRays<D> sheared = broadcast_sheared(d, ray);
  for (int begin = 0; begin < L; begin += lanes_of<D>) {
    const Vertices<D> triangle[3] = {load_vertices(d, block, 0, begin, ray.axes),
                                     load_vertices(d, block, 1, begin, ray.axes),
                                     load_vertices(d, block, 2, begin, ray.axes)};
    const TriangleHits<D> hits = hit_triangles(d, triangle, sheared);
    const auto in_range = hn::And(hn::Ge(hits.t, hn::Set(d, range.t_near)), hn::Le(hits.t, hn::Set(d, range.t_far)));
    std::uint32_t bits = bits_of(d, hn::And(hits.hit, in_range));
    if (bits == 0) continue;
    StoredHits<D> stored;
    stored.store(hits);
    for (; bits != 0; bits &= bits - 1) {
      const int lane = std::countr_zero(bits);
      const std::uint32_t primitive = block.primitives[begin + lane] & ~more_blocks;
      sink.offer(stored.hit(lane, primitive, instance));
    }
  }
}

/// Near children first, so that a sink that wants few hits lowers its cutoff early.
template <class Store>
HWY_INLINE void offer_hits(const WideView& view, const PreparedRay& ray, std::uint32_t instance, HitSink& sink) {
  constexpr int N = Store::children;
  using D = Floats<N>;
  typename Store::NodeBuffer node_buffer;
  typename Store::BlockBuffer block_buffer;
  if (!ray.valid) return;
  const SlabRay<D> slabs = broadcast_slabs(D(), ray);
  const TriangleRay leaf_ray = triangle_ray(ray);
  Postponed stack[wide_stack_limit];
  Postponed* top = stack;
  float t_limit = sink.cutoff() < ray.t_far ? sink.cutoff() : ray.t_far;
  alignas(64) float entry[N];
  for (WideReference current = view.root;;) {
    if (is_leaf(current)) {
      bool more = true;
      for (std::size_t i = 0; more; ++i) {
        const auto& block = Store::block(view, current, i, block_buffer);
        offer_block(block, leaf_ray, ray, instance, sink);
        more = (block.primitives[0] & more_blocks) != 0;
      }
      t_limit = sink.cutoff() < t_limit ? sink.cutoff() : t_limit;
    } else {
      const WideNode<N>& node = Store::node(view, current, node_buffer);
      top = push_sorted(node, hit_children<N>(node, slabs, t_limit, entry), entry, top);
    }
    do {
      if (top == stack) return;
      --top;
    } while (!(top->entry <= t_limit));
    current = top->child;
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace boxwood
HWY_AFTER_NAMESPACE();
#endif
