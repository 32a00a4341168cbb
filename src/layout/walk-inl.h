// The walk through any layout's nodes, and the table of kernels made of it. Compiled once per instruction set.
//
// A layout brings a `Tester`, made once per ray from its nodes and the prepared ray:
//   Slot                                        where a node is; 32 bits unless more must be known to decode it
//   root_box, root_slot, root_link              of the nodes it was made from, which must not be empty
//   link(slot)                                  what is known of that node
//   children(link)                              how many there are
//   test(slot, link, child, from, limit, t)     whether the ray enters that child within [from, limit], and at which t
//   slot_of(slot, link, child)
// A tester whose nodes are parts of boxes brings other tests and has another walk: see segment_walk-inl.h.
#if defined(BOXWOOD_LAYOUT_WALK_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef BOXWOOD_LAYOUT_WALK_INL_H
#undef BOXWOOD_LAYOUT_WALK_INL_H
#else
#define BOXWOOD_LAYOUT_WALK_INL_H
#endif

#include <limits>

#include "layout/encode.h"
#include "layout/kernel_layout.h"
#include "layout/leaf_visit-inl.h"
#include "layout/segment_walk-inl.h"
#include "layout/trace_options.h"

HWY_BEFORE_NAMESPACE();
namespace boxwood {
namespace HWY_NAMESPACE {

/// A child that the ray enters at `t` and that is still to be visited.
template <class Slot>
struct Pending {
  Slot slot;
  float t;
};

template <class Tester, class Leaves, class Visit, ChildOrder order>
struct Walk {
  using Slot = typename Tester::Slot;
  using Pending = HWY_NAMESPACE::Pending<Slot>;

  const Tester& tester;
  const PreparedRay& ray;
  const Leaves& leaves;
  Visit& visit;  // its cutoff: what is entered beyond it is skipped
  float from;

  /// Tests the children of an inner node and puts those that are met on the stack, the first to visit on top.
  HWY_INLINE Pending* open(const Slot& slot, const Link& link, Pending* top) {
    Pending* const base = top;
    const std::uint32_t children = tester.children(link);
    visit.counting.open(children);
    bool descending = false;
    if constexpr (order == ChildOrder::axis) {
      descending = !link.fixed_order && link.axis != Tree::mixed_axis && ray.negative[link.axis];
    }
    for (std::uint32_t n = 0; n < children; ++n) {
      const std::uint32_t child = descending ? n : children - 1 - n;
      float t;
      if (!tester.test(slot, link, child, from, visit.cutoff, t)) continue;
      visit.counting.enter_child();
      Pending* place = top++;
      if constexpr (order == ChildOrder::near) {
        // On equal distance the one stored first stays on top.
        for (; place != base && place[-1].t < t && !link.fixed_order; --place) *place = place[-1];
      }
      *place = {tester.slot_of(slot, link, child), t};
    }
    return top;
  }

  HWY_INLINE bool iterate(Slot slot, Link link, Pending* const stack) {
    for (Pending* top = stack;;) {
      if (link.leaf) {
        if (visit(link, leaves)) return true;
      } else {
        top = open(slot, link, top);
      }
      do {
        if (top == stack) return false;
        --top;
      } while (top->t > visit.cutoff);
      slot = top->slot;
      link = tester.link(slot);
    }
  }

  bool recurse(const Slot& slot, const Link& link, Pending* const stack) {
    if (link.leaf) return visit(link, leaves);
    for (Pending* top = open(slot, link, stack); top != stack;) {
      --top;
      if (top->t > visit.cutoff) continue;
      const Slot child = top->slot;
      if (recurse(child, tester.link(child), top)) return true;
    }
    return false;
  }
};

template <class Tester, ChildOrder order, TraversalMode mode, class Nodes, class Leaves, class Visit>
HWY_INLINE bool walk(const Level<Nodes, Leaves>& level, const PreparedRay& ray, Visit& visit) {
  if (level.nodes.empty()) return false;
  // Without culling nothing is skipped for its distance: not even what lies behind the ray's origin (spec 000, 2.12).
  const float from = level.cull ? ray.t_near : -std::numeric_limits<float>::infinity();
  if constexpr (requires { Tester::segments; }) {
    return walk_segments<Tester, order, mode>(level, ray, from, visit);
  } else {
    const Tester tester(level.nodes, ray);
    float t_root;
    const bool met = hit_box(tester.root_box(), ray, from, visit.cutoff, t_root);
    visit.counting.test_root(met);
    if (!met) return false;
    Pending<typename Tester::Slot> stack[stack_entries];
    Walk<Tester, Leaves, Visit, order> walk{tester, ray, level.leaves, visit, from};
    if constexpr (mode == TraversalMode::iterative) return walk.iterate(tester.root_slot(), tester.root_link(), stack);
    return walk.recurse(tester.root_slot(), tester.root_link(), stack);
  }
}

/// The kernels for one way of walking.
template <class Tester, ChildOrder order, TraversalMode mode, class Nodes, class Leaves>
struct KernelsOf {
  using LevelType = Level<Nodes, Leaves>;

  static float first_cutoff(const LevelType& level, float t_far) {
    return level.cull ? t_far : std::numeric_limits<float>::infinity();
  }

  template <class CountingPolicy>
  static void closest(const LevelType& level, const Ray& ray, Descent descent, Hit& best, RayCounters* counters) {
    const PreparedRay prepared = prepare(ray, level.extent.reach, level.extent.gain);
    if (!prepared.valid) return;
    ClosestVisit<CountingPolicy> visit{ray,
                                       prepared,
                                       descent,
                                       best,
                                       first_cutoff(level, best.t < ray.t_far ? best.t : ray.t_far),
                                       level.cull,
                                       CountingPolicy(counters)};
    walk<Tester, order, mode>(level, prepared, visit);
  }

  template <class CountingPolicy>
  static bool any(const LevelType& level, const Ray& ray, std::uint32_t mask, RayCounters* counters) {
    const PreparedRay prepared = prepare(ray, level.extent.reach, level.extent.gain);
    if (!prepared.valid) return false;
    AnyVisit<CountingPolicy> visit{ray, prepared, mask, first_cutoff(level, ray.t_far), CountingPolicy(counters)};
    return walk<Tester, order, mode>(level, prepared, visit);
  }

  /// Whatever the order of the walk, hits come out the same: one kernel serves all.
  static void offer(const LevelType& level, const Ray& ray, Descent descent, HitSink& sink) {
    const PreparedRay prepared = prepare(ray, level.extent.reach, level.extent.gain);
    if (!prepared.valid) return;
    const float cutoff = sink.cutoff() < ray.t_far ? sink.cutoff() : ray.t_far;
    OfferVisit visit{ray, prepared, descent, sink, cutoff, NoCounting(nullptr)};
    walk<Tester, order, mode>(level, prepared, visit);
  }

  static void closest_batch(const LevelType& level, std::span<const Ray> rays, std::span<Hit> hits) {
    for (std::size_t i = 0; i < rays.size(); ++i) {
      hits[i] = {};
      closest<NoCounting>(level, rays[i], {}, hits[i], nullptr);
    }
  }

  static void any_batch(const LevelType& level, std::span<const Ray> rays, std::span<std::uint8_t> blocked) {
    for (std::size_t i = 0; i < rays.size(); ++i)
      blocked[i] = any<NoCounting>(level, rays[i], every_bit, nullptr) ? 1 : 0;
  }

  static Kernels<Nodes, Leaves> table() {
    return {closest<NoCounting>,
            closest<Counting>,
            any<NoCounting>,
            any<Counting>,
            closest_batch,
            any_batch,
            KernelsOf<Tester, ChildOrder::near, TraversalMode::iterative, Nodes, Leaves>::offer};
  }
};

template <class Tester, ChildOrder order, class Nodes, class Leaves>
Kernels<Nodes, Leaves> kernels_in_order(TraversalMode mode) {
  return mode == TraversalMode::iterative ? KernelsOf<Tester, order, TraversalMode::iterative, Nodes, Leaves>::table()
                                          : KernelsOf<Tester, order, TraversalMode::recursive, Nodes, Leaves>::table();
}

template <class Tester, class Nodes, class Leaves>
Kernels<Nodes, Leaves> choose_kernels(const TraceOptions& options) {
  switch (options.order) {
    case ChildOrder::none:
      return kernels_in_order<Tester, ChildOrder::none, Nodes, Leaves>(options.mode);
    case ChildOrder::axis:
      return kernels_in_order<Tester, ChildOrder::axis, Nodes, Leaves>(options.mode);
    case ChildOrder::near:
      break;
  }
  return kernels_in_order<Tester, ChildOrder::near, Nodes, Leaves>(options.mode);
}

}  // namespace HWY_NAMESPACE
}  // namespace boxwood
HWY_AFTER_NAMESPACE();
#endif
