// The walk through nodes that only narrow the part of the ray inside their parent, as planes do, instead of telling it
// anew, as boxes do. Compiled once per instruction set.
//
// Beside what every tester has (see walk-inl.h), theirs brings `segments`, set, and `binary`. If that is set:
//   test(slot, link, child, part, limit)  what is left of the part in that child, ends included; empty: not met
// else all children together; bits of those that are met are returned:
//   test_all(slot, link, part, limit, parts)
#if defined(BOXWOOD_LAYOUT_SEGMENT_WALK_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef BOXWOOD_LAYOUT_SEGMENT_WALK_INL_H
#undef BOXWOOD_LAYOUT_SEGMENT_WALK_INL_H
#else
#define BOXWOOD_LAYOUT_SEGMENT_WALK_INL_H
#endif

#include <bit>

#include "layout/encode.h"
#include "layout/kernel_layout.h"
#include "layout/leaf_visit-inl.h"
#include "layout/trace_options.h"

HWY_BEFORE_NAMESPACE();
namespace boxwood {
namespace HWY_NAMESPACE {

/// The part [from, exit] of a ray, in t; empty when from > exit.
struct Part {
  float from, exit;
  HWY_INLINE bool empty() const { return !(from <= exit); }
};

HWY_INLINE Part clip(const Box& box, const PreparedRay& ray, Part part) {
  const Vec3* planes = &box.lower;  // [0] lower, [1] upper
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const float t0 = fused(planes[ray.negative[axis]][axis], ray.inverse[axis], -ray.near_offset[axis]);
    const float t1 = fused(planes[1 - ray.negative[axis]][axis], ray.inverse[axis], -ray.far_offset[axis]);
    part.from = t0 > part.from ? t0 : part.from;
    part.exit = t1 < part.exit ? t1 : part.exit;
  }
  return part;
}

/// A child that the ray meets and that is still to be visited.
struct PendingPart {
  std::uint32_t slot;
  Part part;
};

template <class Tester, class Leaves, class Visit, ChildOrder order>
struct SegmentWalk {
  const Tester& tester;
  const PreparedRay& ray;
  const Leaves& leaves;
  Visit& visit;  // its cutoff: what is entered beyond it is skipped

  HWY_INLINE bool descending(const Link& link) const {
    if constexpr (order == ChildOrder::none) return false;
    return !link.fixed_order && link.axis != Tree::mixed_axis && ray.negative[link.axis];
  }

  /// Tests both children of a binary node; those that are met, the first to visit first, and how many they are.
  HWY_INLINE std::uint32_t open_two(std::uint32_t slot, const Link& link, Part part, PendingPart (&met)[2]) {
    visit.counting.open(2);
    // By distance means: where neither is entered first, by the ray's sign on the split axis.
    const std::uint32_t first = descending(link) ? 1 : 0;
    const Part a = tester.test(slot, link, first, part, visit.cutoff);
    const Part b = tester.test(slot, link, 1 - first, part, visit.cutoff);
    const bool swap = order == ChildOrder::near && b.from < a.from && !link.fixed_order;
    const PendingPart near_child{tester.slot_of(slot, link, swap ? 1 - first : first), swap ? b : a};
    const PendingPart far_child{tester.slot_of(slot, link, swap ? first : 1 - first), swap ? a : b};
    const bool near_met = !near_child.part.empty(), far_met = !far_child.part.empty();
    if (near_met) visit.counting.enter_child();
    if (far_met) visit.counting.enter_child();
    met[0] = near_met ? near_child : far_child;
    met[1] = far_child;
    return static_cast<std::uint32_t>(near_met) + static_cast<std::uint32_t>(far_met);
  }

  /// Tests all children of a node and puts those that are met on the stack, the first to visit on top.
  HWY_INLINE PendingPart* open_all(std::uint32_t slot, const Link& link, Part part, PendingPart* top) {
    visit.counting.open(tester.children(link));
    Part parts[Tester::most_children];
    const std::uint32_t met = tester.test_all(slot, link, part, visit.cutoff, parts);
    const bool down = order == ChildOrder::axis && descending(link);
    PendingPart* const base = top;
    for (std::uint32_t left = met; left != 0;) {
      // The last to visit first.
      const auto child = static_cast<std::uint32_t>(down ? std::countr_zero(left) : 31 - std::countl_zero(left));
      left &= ~(1u << child);
      visit.counting.enter_child();
      const PendingPart next{tester.slot_of(slot, link, child), parts[child]};
      PendingPart* place = top++;
      if constexpr (order == ChildOrder::near) {
        for (; place != base && place[-1].part.from < next.part.from && !link.fixed_order; --place) {
          *place = place[-1];
        }
      }
      *place = next;
    }
    return top;
  }

  HWY_INLINE bool iterate(std::uint32_t slot, Link link, Part part, PendingPart* const stack) {
    for (PendingPart* top = stack;;) {
      if (link.leaf) {
        if (visit(link, leaves)) return true;
      } else if constexpr (Tester::binary) {
        PendingPart met[2];
        if (const std::uint32_t count = open_two(slot, link, part, met)) {
          if (count == 2) *top++ = met[1];
          slot = met[0].slot;
          part = met[0].part;
          link = tester.link(slot);
          continue;
        }
      } else {
        top = open_all(slot, link, part, top);
      }
      do {
        if (top == stack) return false;
        --top;
      } while (top->part.from > visit.cutoff);
      slot = top->slot;
      part = top->part;
      link = tester.link(slot);
    }
  }

  bool recurse(std::uint32_t slot, const Link& link, Part part, PendingPart* const stack) {
    if (link.leaf) return visit(link, leaves);
    if constexpr (Tester::binary) {
      PendingPart met[2];
      const std::uint32_t count = open_two(slot, link, part, met);
      for (std::uint32_t i = 0; i < count; ++i) {
        if (met[i].part.from > visit.cutoff) continue;
        if (recurse(met[i].slot, tester.link(met[i].slot), met[i].part, stack)) return true;
      }
    } else {
      for (PendingPart* top = open_all(slot, link, part, stack); top != stack;) {
        const PendingPart next = *--top;
        if (next.part.from > visit.cutoff) continue;
        if (recurse(next.slot, tester.link(next.slot), next.part, top)) return true;
      }
    }
    return false;
  }
};

/// As walk() in walk-inl.h. The ray is first clipped to the root's box, which is that test's whole cost to the layout.
template <class Tester, ChildOrder order, TraversalMode mode, class Nodes, class Leaves, class Visit>
HWY_INLINE bool walk_segments(const Level<Nodes, Leaves>& level, const PreparedRay& ray, float from, Visit& visit) {
  const Tester tester(level.nodes, ray);
  const Part part = clip(tester.root_box(), ray, {from, visit.cutoff});
  visit.counting.test_root(!part.empty());
  if (part.empty()) return false;
  PendingPart stack[stack_entries];
  SegmentWalk<Tester, Leaves, Visit, order> walk{tester, ray, level.leaves, visit};
  if constexpr (mode == TraversalMode::iterative) {
    return walk.iterate(tester.root_slot(), tester.root_link(), part, stack);
  }
  return walk.recurse(tester.root_slot(), tester.root_link(), part, stack);
}

}  // namespace HWY_NAMESPACE
}  // namespace boxwood
HWY_AFTER_NAMESPACE();
#endif
