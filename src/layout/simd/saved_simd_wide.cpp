#include <algorithm>
#include <limits>
#include <vector>

#include "layout/saved_kind.h"
#include "layout/simd/saved_walk.h"
#include "layout/simd/simd_layout.h"
#include "layout/simd/wide_arena.h"

namespace boxwood {
namespace {

/// An arena in memory that someone else keeps.
struct KeptArena {
  std::span<const std::byte> memory;
  std::shared_ptr<const void> owner;
  SavedFacts saved;
  WideView view;
  WideShape shape;

  std::size_t bytes() const { return memory.size(); }
  std::vector<LayoutFact> facts() const { return wide_facts(shape, bytes()); }
  void save(SavedLevel& out) const {
    out.facts = saved;
    out.nodes = memory;
  }
};

/// What lies where in an arena; each granule may belong to one thing only.
template <int N, int L>
class ArenaCheck {
 public:
  explicit ArenaCheck(const SavedLevel& level)
      : memory_(level.nodes), facts_(level.facts), taken_(level.nodes.size() / wide_granule) {}

  std::string run() {
    if (memory_.size() < wide_offset(wide_reference(64, false)) + sizeof(WideNode<N>)) return "it has no root";
    if (facts_.stack > wide_stack_limit) return "it is deeper than any walk can go";
    if (is_leaf(facts_.root_reference)) return "its root is a leaf";
    const std::optional<WideReference> bad = find_bad_reference<N>(facts_.root_reference, facts_.stack, *this);
    if (!bad) return {};
    return fmt::format("what lies at byte {} is no proper {}", wide_offset(*bad), is_leaf(*bad) ? "leaf" : "node");
  }

  const WideNode<N>* take_node(WideReference reference) {
    const std::size_t offset = wide_offset(reference);
    if (offset % alignof(WideNode<N>) != 0 || !take(offset, sizeof(WideNode<N>))) return nullptr;
    return reinterpret_cast<const WideNode<N>*>(memory_.data() + offset);
  }

  bool take_leaf(WideReference reference) {
    bool more = true;
    for (std::size_t offset = wide_offset(reference); more; offset += sizeof(LeafBlock<L>)) {
      if (!take(offset, sizeof(LeafBlock<L>))) return false;
      const auto& block = *reinterpret_cast<const LeafBlock<L>*>(memory_.data() + offset);
      more = (block.primitives[0] & more_blocks) != 0;
      for (int lane = 0; lane < L; ++lane) {
        if ((block.primitives[lane] & ~(lane == 0 ? more_blocks : 0)) >= facts_.primitives) return false;
      }
    }
    return true;
  }

  static WideReference child(const WideNode<N>& node, int lane) { return node.children[lane]; }
  static Box box(const WideNode<N>& node, int lane) {
    Box out;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      out.lower[axis] = node.planes[2 * axis][lane];
      out.upper[axis] = node.planes[2 * axis + 1][lane];
    }
    return out;
  }
  static bool is_unused(const WideNode<N>& node, int lane) {
    const Box nothing, found = box(node, lane);
    return node.children[lane] == wide_nothing && found.lower == nothing.lower && found.upper == nothing.upper;
  }

 private:
  bool take(std::size_t offset, std::size_t bytes) {
    if (offset < 64 || offset + bytes > memory_.size()) return false;
    const auto begin = taken_.begin() + static_cast<std::ptrdiff_t>(offset / wide_granule);
    const auto end = begin + static_cast<std::ptrdiff_t>(bytes / wide_granule);
    if (std::find(begin, end, true) != end) return false;
    std::fill(begin, end, true);
    return true;
  }

  std::span<const std::byte> memory_;
  const SavedFacts& facts_;
  std::vector<bool> taken_;
};

/// Calls use.template operator()<N, L>() for the nodes and blocks that the level has.
template <class Use>
auto with_shape(const SavedFacts& facts, const Use& use) {
  if (facts.children == 4 && facts.block == 4) return use.template operator()<4, 4>();
  if (facts.children == 8 && facts.block == 4) return use.template operator()<8, 4>();
  if (facts.children == 8 && facts.block == 8) return use.template operator()<8, 8>();
  if (facts.children == 16 && facts.block == 8) return use.template operator()<16, 8>();
  throw Error(fmt::format("it has nodes of {} children and blocks of {} triangles, which no kernel traces",
                          facts.children, facts.block));
}

std::string simd_wide_damage(const SavedLevel& level) {
  if (!level.leaves.empty() || level.facts.instances) return "it has leaves where none belong";
  return with_shape(level.facts, [&]<int N, int L>() { return ArenaCheck<N, L>(level).run(); });
}

std::shared_ptr<const Layout> restore_simd_wide(const SavedLevel& level, const TraceOptions& trace) {
  const SavedFacts& facts = level.facts;
  if (trace != TraceOptions{}) throw Error("it is to be walked in a way that its nodes are not made for");
  if (facts.nodes > level.nodes.size() / 64 || level.nodes.size() % wide_granule != 0 || level.nodes.size() < 64 ||
      facts.stack > wide_stack_limit) {
    throw Error("its nodes end within one");
  }
  WideView view;
  view.base = level.nodes.data();
  view.root = facts.root_reference;
  view.reach = facts.reach;
  view.stack = facts.stack;
  view.out_of_cache = facts.out_of_cache != 0;
  return with_shape(facts, [&]<int N, int L>() -> std::shared_ptr<const Layout> {
    const WideShape shape{facts.nodes, facts.nodes * sizeof(WideNode<N>), N, facts.inner_children, facts.triangles};
    return std::make_shared<SimdLayout<KeptArena>>(KeptArena{level.nodes, level.owner, facts, view, shape},
                                                   wide_kernels<N, L>());
  });
}

/// Empty lanes of the root hold empty boxes.
Box simd_wide_bounds(const SavedLevel& level) {
  return with_shape(level.facts, [&]<int N, int L>() {
    const std::size_t offset = wide_offset(level.facts.root_reference);
    Box bounds;
    if (offset + sizeof(WideNode<N>) > level.nodes.size()) return bounds;
    WideNode<N> root;
    std::memcpy(&root, level.nodes.data() + offset, sizeof root);
    for (int lane = 0; lane < N; ++lane) {
      bounds.grow(Box{{root.planes[0][lane], root.planes[2][lane], root.planes[4][lane]},
                      {root.planes[1][lane], root.planes[3][lane], root.planes[5][lane]}});
    }
    return bounds;
  });
}

}  // namespace

SavedKindEntry saved_simd_wide() {
  return {SavedKind::simd_wide, simd_wide_damage, restore_simd_wide, simd_wide_bounds};
}

}  // namespace boxwood
