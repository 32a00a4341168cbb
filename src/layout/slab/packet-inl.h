// Packets: 4, 8 or 16 rays of a batch walk the nodes of slab or binary-split together (spec 003, 1.9 and 2.6). A test
// counts for every ray of its packet. Compiled once per instruction set.
#if defined(BOXWOOD_LAYOUT_SLAB_PACKET_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef BOXWOOD_LAYOUT_SLAB_PACKET_INL_H
#undef BOXWOOD_LAYOUT_SLAB_PACKET_INL_H
#else
#define BOXWOOD_LAYOUT_SLAB_PACKET_INL_H
#endif

#include "layout/kernel_layout.h"
#include "layout/leaf_visit-inl.h"
#include "layout/slab/packet_rays-inl.h"
#include "layout/trace_options.h"

HWY_BEFORE_NAMESPACE();
namespace boxwood {
namespace HWY_NAMESPACE {

template <int N>
class PacketSlab {
 public:
  explicit PacketSlab(const PacketRays<N>& rays) : planes_(rays) {}
  template <class Word>
  HWY_INLINE bool narrow(const SlabNode<Word>& node, const Parts<N>& parts, Parts<N>& left) const {
    return planes_.narrow(node.plane, node.word.flags().side(), parts, left);
  }

 private:
  PacketPlanes<N> planes_;
};

template <int N>
class PacketBox {
 public:
  explicit PacketBox(const PacketRays<N>& rays) : rays_(rays) {}
  template <class Word>
  HWY_INLINE bool narrow(const BoxNode<Word>& node, const Parts<N>& parts, Parts<N>& left) const {
    return clip_parts(node.bounds, rays_, parts, left);
  }

 private:
  const PacketRays<N>& rays_;
};

template <int N, class Word>
PacketSlab<N> packet_volume_of(const SlabNode<Word>&);
template <int N, class Word>
PacketBox<N> packet_volume_of(const BoxNode<Word>&);

/// Closest hits so far.
template <int N>
struct PacketClosest {
  PacketRays<N>& rays;
  Hit* hits;

  HWY_INLINE void operator()(const LeafTriangle& triangle) {
    hit_by_packet(triangle, rays, [&](int first, const auto& found) HWY_ATTR {
      const PacketTag<N> d;
      alignas(64) float t[strip<N>], v[strip<N>], w[strip<N>], determinant[strip<N>];
      hn::Store(found.t, d, t);
      hn::Store(found.v, d, v);
      hn::Store(found.w, d, w);
      hn::Store(found.determinant, d, determinant);
      for (std::uint32_t bits = bits_of(d, found.hit); bits != 0; bits &= bits - 1) {
        const int lane = std::countr_zero(bits);
        Hit& best = hits[first + lane];
        if (!wins(t[lane], 0, triangle.primitive, best)) continue;
        best = {t[lane], v[lane] / determinant[lane], w[lane] / determinant[lane], triangle.primitive, 0};
        rays.limit.lanes[first + lane] = t[lane];
      }
    });
  }
};

/// A ray that is blocked gets a limit before its beginning and so meets nothing more.
template <int N>
struct PacketAny {
  PacketRays<N>& rays;

  HWY_INLINE void operator()(const LeafTriangle& triangle) {
    hit_by_packet(triangle, rays, [&](int first, const auto& found) HWY_ATTR {
      const PacketTag<N> d;
      float* limits = rays.limit.lanes + first;
      const auto done = hn::Set(d, -std::numeric_limits<float>::infinity());
      hn::Store(hn::IfThenElse(found.hit, done, hn::Load(d, limits)), d, limits);
    });
  }
};

template <int N, class Nodes, class AtTriangle, class CountingPolicy>
class PacketWalk {
 public:
  PacketWalk(const Level<Nodes, TriangleLeaves>& level, const PacketRays<N>& rays, bool ordered, AtTriangle at_triangle,
             CountingPolicy counting)
      : nodes_(level.nodes),
        leaves_(level.leaves),
        rays_(rays),
        ordered_(ordered),
        volume_(rays),
        at_triangle_(at_triangle),
        counting_(counting) {}

  HWY_INLINE void run(TraversalMode mode) {
    Parts<N> parts{rays_.t_near, rays_.limit};
    const bool met = clip_parts(nodes_.root_box, rays_, parts, parts);
    counting_.test_root(met);
    if (!met) return;
    if (mode == TraversalMode::iterative) {
      iterate(parts);
    } else {
      recurse(nodes_.link_of(nodes_.root), parts);
    }
  }

 private:
  struct Pending {
    std::size_t place;
    Parts<N> parts;
  };

  HWY_INLINE void visit_leaf(const Link& leaf) {
    counting_.leaf();
    for (const LeafTriangle *t = leaves_.triangles.data() + leaf.first, *end = t + leaf.count; t != end; ++t) {
      counting_.primitive();
      at_triangle_(*t);
    }
  }

  /// The place of the child to visit first or last.
  HWY_INLINE std::size_t child_of(const Link& link, bool first) const {
    const bool descending = ordered_ && !link.fixed_order && rays_.negative[link.axis] != 0;
    return 2 * std::size_t{link.first} + (descending == first ? 1 : 0);
  }

  HWY_INLINE bool test(std::size_t place, const Parts<N>& parts, Parts<N>& left) {
    const bool met = volume_.narrow(nodes_.pairs[place], parts, left);
    if (met) counting_.enter_child();
    return met;
  }

  HWY_INLINE void iterate(const Parts<N>& all) {
    Pending stack[most_packet_entries];
    Pending* top = stack;
    Parts<N> parts = all;
    for (Link link = nodes_.link_of(nodes_.root);;) {
      if (link.leaf) {
        visit_leaf(link);
      } else {
        counting_.open(2);
        const std::size_t first = child_of(link, true), last = child_of(link, false);
        if (test(last, parts, top->parts)) (top++)->place = last;
        if (test(first, parts, parts)) {
          link = nodes_.link_of(nodes_.pairs[first]);
          continue;
        }
      }
      do {
        if (top == stack) return;
        --top;
      } while (!limit_parts(rays_, top->parts, parts));
      link = nodes_.link_of(nodes_.pairs[top->place]);
    }
  }

  void recurse(const Link& link, const Parts<N>& parts) {
    if (link.leaf) return visit_leaf(link);
    counting_.open(2);
    const std::size_t first = child_of(link, true), last = child_of(link, false);
    Parts<N> first_parts, last_parts;
    const bool meets_last = test(last, parts, last_parts);
    if (test(first, parts, first_parts)) recurse(nodes_.link_of(nodes_.pairs[first]), first_parts);
    if (meets_last && limit_parts(rays_, last_parts, last_parts)) {
      recurse(nodes_.link_of(nodes_.pairs[last]), last_parts);
    }
  }

  using Node = typename Nodes::Node;
  const Nodes& nodes_;
  const TriangleLeaves& leaves_;
  const PacketRays<N>& rays_;
  const bool ordered_;
  decltype(packet_volume_of<N>(std::declval<Node>())) volume_;
  AtTriangle at_triangle_;
  CountingPolicy counting_;
};

/// How a packet is walked, known only when the program runs: it costs nothing beside what N rays do.
struct PacketOrder {
  TraversalMode mode;
  bool ordered;
};

/// False, and nothing written, when the N rays are not alike.
template <class Nodes, int N, class CountingPolicy>
HWY_NOINLINE bool closest_of_packet(const Level<Nodes, TriangleLeaves>& level, PacketOrder order, const Ray* rays,
                                    Hit* hits, RayCounters* counters) {
  PacketRays<N> packet;
  if (level.nodes.empty() || !packet.prepare_all(rays, level.extent.reach, level.extent.gain)) return false;
  std::fill_n(hits, N, Hit{});
  PacketWalk<N, Nodes, PacketClosest<N>, CountingPolicy>(level, packet, order.ordered, {packet, hits},
                                                         CountingPolicy(counters))
      .run(order.mode);
  return true;
}

template <class Nodes, int N, class CountingPolicy>
HWY_NOINLINE bool any_of_packet(const Level<Nodes, TriangleLeaves>& level, PacketOrder order, const Ray* rays,
                                std::uint8_t* blocked, RayCounters* counters) {
  PacketRays<N> packet;
  if (level.nodes.empty() || !packet.prepare_all(rays, level.extent.reach, level.extent.gain)) return false;
  PacketWalk<N, Nodes, PacketAny<N>, CountingPolicy>(level, packet, order.ordered, {packet}, CountingPolicy(counters))
      .run(order.mode);
  for (int i = 0; i < N; ++i) blocked[i] = packet.limit.lanes[i] < packet.t_near.lanes[i] ? 1 : 0;
  return true;
}

}  // namespace HWY_NAMESPACE
}  // namespace boxwood
HWY_AFTER_NAMESPACE();
#endif
