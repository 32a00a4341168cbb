// How one ray meets the nodes of slab and binary-split. Compiled once per instruction set.
#if defined(BOXWOOD_LAYOUT_SLAB_SPLIT_TESTERS_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef BOXWOOD_LAYOUT_SLAB_SPLIT_TESTERS_INL_H
#undef BOXWOOD_LAYOUT_SLAB_SPLIT_TESTERS_INL_H
#else
#define BOXWOOD_LAYOUT_SLAB_SPLIT_TESTERS_INL_H
#endif

#include "layout/segment_walk-inl.h"
#include "layout/slab/plane_rows-inl.h"
#include "layout/slab/split_nodes.h"

HWY_BEFORE_NAMESPACE();
namespace boxwood {
namespace HWY_NAMESPACE {

/// The one difference between the two: what is left of a part of the ray inside a node.
class SlabVolume {
 public:
  explicit SlabVolume(const PreparedRay& ray) : rows_(ray) {}
  template <class Word>
  HWY_INLINE Part narrow(const SlabNode<Word>& node, Part part) const {
    return rows_.narrow(node.plane, node.word.flags().side(), part);
  }

 private:
  PlaneRows rows_;
};

class BoxVolume {
 public:
  explicit BoxVolume(const PreparedRay& ray) : ray_(ray) {}
  template <class Word>
  HWY_INLINE Part narrow(const BoxNode<Word>& node, Part part) const {
    return clip(node.bounds, ray_, part);
  }

 private:
  const PreparedRay& ray_;
};

template <class Word>
SlabVolume volume_of(const SlabNode<Word>&);
template <class Word>
BoxVolume volume_of(const BoxNode<Word>&);

/// A slot is a node's place among the pairs; the root is never tested as a child.
template <class Nodes>
class SplitTester {
 public:
  static constexpr bool segments = true, binary = true;

  SplitTester(const Nodes& nodes, const PreparedRay& ray) : nodes_(nodes), pairs_(nodes.pairs.data()), volume_(ray) {}

  const Box& root_box() const { return nodes_.root_box; }
  static std::uint32_t root_slot() { return 0; }
  Link root_link() const { return nodes_.link_of(nodes_.root); }
  HWY_INLINE Link link(std::uint32_t slot) const { return nodes_.link_of(pairs_[slot]); }
  static constexpr std::uint32_t children(const Link&) { return 2; }
  static HWY_INLINE std::uint32_t slot_of(std::uint32_t, const Link& link, std::uint32_t child) {
    return 2 * link.first + child;
  }
  HWY_INLINE Part test(std::uint32_t, const Link& link, std::uint32_t child, Part part, float limit) const {
    part.exit = limit < part.exit ? limit : part.exit;
    return volume_.narrow(pairs_[2 * std::size_t{link.first} + child], part);
  }

 private:
  using Node = typename Nodes::Node;
  const Nodes& nodes_;
  const Node* pairs_;
  decltype(volume_of(std::declval<Node>())) volume_;
};

}  // namespace HWY_NAMESPACE
}  // namespace boxwood
HWY_AFTER_NAMESPACE();
#endif
