// One ray on its way through wide nodes, leaf by leaf: for content that is visited in other ways than triangles are.
// Compiled once per instruction set.
#if defined(BOXWOOD_LAYOUT_WIDE_LEAF_WALK_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef BOXWOOD_LAYOUT_WIDE_LEAF_WALK_INL_H
#undef BOXWOOD_LAYOUT_WIDE_LEAF_WALK_INL_H
#else
#define BOXWOOD_LAYOUT_WIDE_LEAF_WALK_INL_H
#endif

#include <bit>
#include <cstring>

#include "layout/leaf_visit-inl.h"
#include "layout/simd/lanes-inl.h"
#include "layout/wide/wide_nodes.h"
#include "trace/prepared_ray-inl.h"

HWY_BEFORE_NAMESPACE();
namespace boxwood {
namespace HWY_NAMESPACE {

/// At a leaf; at the end; or on the way to more open ends than there is room for, so that the walk is void.
enum class LeafStep : std::uint8_t { visit, done, overflow };

/// Through nodes of K children, from near to far, with room for `open_ends` of them. Tests all children of a node at
/// once. Refers to nothing: the nodes are given again with every step.
template <int K, std::uint32_t open_ends>
class LeafWalk {
  using D = Floats<K>;

 public:
  // Leaves the room for open ends as it is: filling it would take longer than many a walk.
  LeafWalk() {}  // NOLINT(clang-analyzer-optin.cplusplus.UninitializedObject): start() comes first
  /// False when the ray meets nothing.
  template <class CountingPolicy>
  HWY_INLINE bool start(const WideNodes& nodes, const Reach& extent, const Ray& ray, CountingPolicy& counting) {
    top_ = 0;
    prepared_ = prepare(ray, extent.reach, extent.gain);
    float entry;
    if (!prepared_.valid || nodes.empty()) return false;
    const bool met = hit_box(nodes.root_box, prepared_, ray.t_far, entry);
    counting.test_root(met);
    if (met) push_link(nodes.root, entry, 0);
    return met;
  }

  /// Goes on to the next leaf that the ray enters at or before `limit`.
  template <class CountingPolicy>
  HWY_INLINE LeafStep next(const WideNodes& nodes, float limit, Link& leaf, CountingPolicy& counting) {
    for (;;) {
      do {
        if (top_ == 0) return LeafStep::done;
        --top_;
      } while (!(open_[top_].entry <= limit));
      const Link link = open_[top_].link;
      if (link.leaf) {
        counting.leaf();
        leaf = link;
        return LeafStep::visit;
      }
      if (!open_node(nodes, link, limit, counting)) return LeafStep::overflow;
    }
  }

 private:
  struct Open {
    Link link;
    float entry;
  };

  HWY_INLINE void push_link(const Link& link, float entry, std::uint32_t bottom) {
    std::uint32_t place = top_++;
    for (; place != bottom && open_[place - 1].entry < entry; --place) open_[place] = open_[place - 1];
    open_[place] = {link, entry};
  }

  /// Puts the children that are met on the stack, the nearest on top.
  template <class CountingPolicy>
  HWY_INLINE bool open_node(const WideNodes& nodes, const Link& link, float limit, CountingPolicy& counting) {
    if (HWY_UNLIKELY(top_ + link.count > open_ends)) return false;
    const D d;
    const float* node = nodes.memory.data() + std::size_t{link.first} * (8 * K);
    const std::uint32_t bottom = top_;
    counting.open(link.count);
    alignas(64) float entries[K];
    for (int begin = 0; begin < K; begin += lanes_of<D>) {
      auto entry = hn::Set(d, prepared_.t_near), exit = hn::Set(d, limit);
      for (int axis = 0; axis < 3; ++axis) {
        const auto inverse = hn::Set(d, prepared_.inverse[axis]);
        const int near = axis + 3 * prepared_.negative[axis], far = axis + 3 * (1 - prepared_.negative[axis]);
        const auto near_plane = hn::LoadU(d, node + near * K + begin), far_plane = hn::LoadU(d, node + far * K + begin);
        entry = hn::Max(hn::MulSub(near_plane, inverse, hn::Set(d, prepared_.near_offset[axis])), entry);
        exit = hn::Min(hn::MulSub(far_plane, inverse, hn::Set(d, prepared_.far_offset[axis])), exit);
      }
      hn::Store(entry, d, entries + begin);
      std::uint32_t bits = bits_of(d, hn::Le(entry, exit)) << begin;
      for (bits &= (1u << link.count) - 1; bits != 0; bits &= bits - 1) {
        const int child = std::countr_zero(bits);
        Link to;
        std::memcpy(static_cast<void*>(&to), node + 6 * K + 2 * child, sizeof to);
        counting.enter_child();
        push_link(to, entries[child], bottom);
      }
    }
    return true;
  }

  PreparedRay prepared_;
  std::uint32_t top_;
  union {
    Open open_[open_ends];
  };
};

}  // namespace HWY_NAMESPACE
}  // namespace boxwood
HWY_AFTER_NAMESPACE();
#endif
