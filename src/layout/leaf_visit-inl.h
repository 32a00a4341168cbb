// What a walk does when it comes to a leaf: test triangles, or go down into instances. Compiled once per instruction
// set.
#if defined(BOXWOOD_LAYOUT_LEAF_VISIT_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef BOXWOOD_LAYOUT_LEAF_VISIT_INL_H
#undef BOXWOOD_LAYOUT_LEAF_VISIT_INL_H
#else
#define BOXWOOD_LAYOUT_LEAF_VISIT_INL_H
#endif

#include "layout/leaves.h"
#include "layout/link.h"
#include "trace/object_ray.h"
#include "trace/triangle-inl.h"

HWY_BEFORE_NAMESPACE();
namespace boxwood {
namespace HWY_NAMESPACE {

/// Counting policy of the timed kernels: nothing.
struct NoCounting {
  explicit NoCounting(RayCounters*) {}
  HWY_INLINE void test_root(bool) {}
  HWY_INLINE void open(std::uint32_t) {}
  HWY_INLINE void enter_child() {}
  HWY_INLINE void leaf() {}
  HWY_INLINE void primitive() {}
  RayCounters* below() const { return nullptr; }
};

/// The root's box is one test; every visit of an inner node tests each of its children's boxes once, before any of them
/// is entered. What is put off and later skipped, because a hit came nearer, is tested and met but not visited. Going
/// into an instance is a leaf's work; it counts like a walk of its own, root included.
struct Counting {
  explicit Counting(RayCounters* counters) : sum(*counters) {}
  HWY_INLINE void test_root(bool hit) {
    ++sum.node_tests;
    sum.node_hits += hit ? 1 : 0;
  }
  HWY_INLINE void open(std::uint32_t children) {
    ++sum.steps;
    sum.node_tests += children;
  }
  HWY_INLINE void enter_child() { ++sum.node_hits; }
  HWY_INLINE void leaf() { ++sum.leaves; }
  HWY_INLINE void primitive() { ++sum.primitive_tests; }
  RayCounters* below() const { return &sum; }
  RayCounters& sum;
};

/// What a ray brings along into what is placed there.
HWY_INLINE Descent into(const InstanceLeaf& placed, Descent descent) {
  return {descent.first_instance + placed.instance, descent.mask};
}

/// The closest-hit query. `cutoff` is lowered only when culling, which costs nothing where no hit is found.
template <class CountingPolicy>
struct ClosestVisit {
  const Ray& ray;
  const PreparedRay& prepared;
  Descent descent;
  Hit& best;
  float cutoff;
  bool cull;
  CountingPolicy counting;

  HWY_INLINE void lower_cutoff() {
    if (cull && best.t < cutoff) cutoff = best.t;
  }
  HWY_INLINE bool operator()(const Link& leaf, const TriangleLeaves& leaves) {
    counting.leaf();
    for (const LeafTriangle *t = leaves.triangles.data() + leaf.first, *end = t + leaf.count; t != end; ++t) entry(*t);
    return false;
  }
  HWY_INLINE bool operator()(const Link& leaf, const InstanceLeaves& leaves) {
    counting.leaf();
    for (const InstanceLeaf *i = leaves.instances.data() + leaf.first, *end = i + leaf.count; i != end; ++i) entry(*i);
    return false;
  }

  /// One entry of a leaf.
  HWY_INLINE bool entry(const LeafTriangle& triangle) {
    counting.primitive();
    if (closest_of(triangle, prepared, descent.first_instance, best)) lower_cutoff();
    return false;
  }
  HWY_INLINE bool entry(const InstanceLeaf& placed) {
    if ((placed.mask & descent.mask) == 0) return false;
    placed.bottom->closest_below(object_ray(placed.world_to_object, ray), into(placed, descent), best,
                                 counting.below());
    lower_cutoff();
    return false;
  }
};

/// The any-hit query: a leaf that blocks the ray ends the walk.
template <class CountingPolicy>
struct AnyVisit {
  const Ray& ray;
  const PreparedRay& prepared;
  std::uint32_t mask;
  float cutoff;
  CountingPolicy counting;

  HWY_INLINE bool operator()(const Link& leaf, const TriangleLeaves& leaves) {
    counting.leaf();
    for (const LeafTriangle *t = leaves.triangles.data() + leaf.first, *end = t + leaf.count; t != end; ++t) {
      if (entry(*t)) return true;
    }
    return false;
  }
  HWY_INLINE bool operator()(const Link& leaf, const InstanceLeaves& leaves) {
    counting.leaf();
    for (const InstanceLeaf *i = leaves.instances.data() + leaf.first, *end = i + leaf.count; i != end; ++i) {
      if (entry(*i)) return true;
    }
    return false;
  }

  HWY_INLINE bool entry(const LeafTriangle& triangle) {
    counting.primitive();
    return blocks(triangle, prepared);
  }
  HWY_INLINE bool entry(const InstanceLeaf& placed) {
    if ((placed.mask & mask) == 0) return false;
    return placed.bottom->any_below(object_ray(placed.world_to_object, ray), mask, counting.below());
  }
};

/// All hits, brought to a sink.
struct OfferVisit {
  const Ray& ray;
  const PreparedRay& prepared;
  Descent descent;
  HitSink& sink;
  float cutoff;
  NoCounting counting;

  HWY_INLINE bool operator()(const Link& leaf, const TriangleLeaves& leaves) {
    for (const LeafTriangle *t = leaves.triangles.data() + leaf.first, *end = t + leaf.count; t != end; ++t) entry(*t);
    return false;
  }
  HWY_INLINE bool operator()(const Link& leaf, const InstanceLeaves& leaves) {
    for (const InstanceLeaf *i = leaves.instances.data() + leaf.first, *end = i + leaf.count; i != end; ++i) entry(*i);
    return false;
  }

  HWY_INLINE bool entry(const LeafTriangle& triangle) {
    TriangleHit hit;
    if (!hit_triangle(triangle.a, triangle.b, triangle.c, prepared, hit)) return false;
    if (!(hit.t >= ray.t_near && hit.t <= ray.t_far)) return false;
    sink.offer({hit.t, hit.v / hit.determinant, hit.w / hit.determinant, triangle.primitive, descent.first_instance});
    lower_cutoff();
    return false;
  }
  HWY_INLINE bool entry(const InstanceLeaf& placed) {
    if ((placed.mask & descent.mask) == 0) return false;
    placed.bottom->offer_hits(object_ray(placed.world_to_object, ray), into(placed, descent), sink);
    lower_cutoff();
    return false;
  }
  HWY_INLINE void lower_cutoff() {
    if (sink.cutoff() < cutoff) cutoff = sink.cutoff();
  }
};

}  // namespace HWY_NAMESPACE
}  // namespace boxwood
HWY_AFTER_NAMESPACE();
#endif
