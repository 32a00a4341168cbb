// How a tree of fixed arity is cut into chunks of bits: spec 004, sections 2.4 and 2.7. No layout, only the plan, so
// that octrees and quantized trees share it.
#pragma once
#include <cstddef>
#include <cstdint>
#include <deque>
#include <vector>

namespace boxwood {

/// The descendants of one inner node, its implicit root, cut off where the chunk is full. Bits are numbered from
/// `first_node`; groups of siblings are never parted.
struct PlannedChunk {
  std::uint32_t child_chunks = 0;  ///< number of the chunk of its first inner node whose children are elsewhere
  std::uint32_t first_leaf = 0;    ///< leaves in all earlier chunks
  std::uint32_t first_node = 0;    ///< nodes in all earlier chunks
};

/// All nodes but the root, chunk by chunk.
template <class Item>
struct ChunkPlan {
  std::vector<PlannedChunk> chunks;
  std::vector<Item> nodes;
  std::vector<std::uint8_t> inner;  ///< [i]: nodes[i] is an inner node
  std::vector<std::uint8_t> kept;   ///< [i]: its children are in its own chunk

  std::size_t nodes_of(std::size_t chunk) const {
    return (chunk + 1 < chunks.size() ? chunks[chunk + 1].first_node : nodes.size()) - chunks[chunk].first_node;
  }
};

/// Breadth-first: a chunk takes nodes from its root down; inner nodes whose children are not to be in it become roots
/// of chunks of their own, in the same order.
///   children(item, out)   fills out[arity] with the children of an inner node, in order
///   is_inner(item)
///   keeps(item, groups)   whether an inner node's children go into the same chunk, which has so many groups already
template <std::uint32_t arity, class Item, class Children, class IsInner, class Keeps>
ChunkPlan<Item> plan_chunks(const Item& root, const Children& children, const IsInner& is_inner, const Keeps& keeps) {
  ChunkPlan<Item> plan;
  if (!is_inner(root)) return plan;
  std::deque<Item> roots{root};  // of chunks planned and to be planned
  std::uint32_t leaves = 0, chunks_known = 1;
  std::vector<Item> pending;
  for (; !roots.empty(); roots.pop_front()) {
    plan.chunks.push_back({chunks_known, leaves, static_cast<std::uint32_t>(plan.nodes.size())});
    pending.assign(1, roots.front());
    for (std::size_t p = 0; p < pending.size(); ++p) {
      const Item parent = pending[p];
      Item group[arity];
      children(parent, group);
      for (const Item& child : group) {
        const bool inner = is_inner(child);
        const bool kept = inner && keeps(child, static_cast<std::uint32_t>(pending.size()));
        plan.nodes.push_back(child);
        plan.inner.push_back(inner ? 1 : 0);
        plan.kept.push_back(kept ? 1 : 0);
        if (kept) pending.push_back(child);
        if (!inner) ++leaves;
        if (inner && !kept) {
          roots.push_back(child);
          ++chunks_known;
        }
      }
    }
  }
  return plan;
}

/// The study's way to fill chunks: as long as there is room for another of `groups` groups. The first groups - 1 inner
/// nodes of a chunk are then the ones that have their children in it, so that one bit per node says all.
inline auto keeps_while_room(std::uint32_t groups) {
  return [groups](const auto&, std::uint32_t taken) { return taken < groups; };
}

}  // namespace boxwood
