#pragma once
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "boxwood/box.h"
#include "boxwood/layout_fact.h"
#include "boxwood/scene.h"
#include "layout/simd/arena.h"
#include "layout/simd/wide_node.h"

namespace boxwood {

struct Tree;

/// A tree as the kernels see it. The root is always a node, even of an empty tree or of one leaf.
struct WideView {
  const std::byte* base = nullptr;
  WideReference root = wide_nothing;
  float reach = 0;            ///< largest absolute coordinate of anything in it
  std::uint32_t stack = 0;    ///< most entries a traversal's stack can hold
  bool out_of_cache = false;  ///< too large for a core's own caches, so that prefetches pay

  bool tight = false;  ///< packed leaves may be tight (../compressed/packed_leaf.h)
  // Where leaves only name their triangles: the caller's mesh; null where none does.
  const Vec3* positions = nullptr;
  const Triangle* triangles = nullptr;
};

/// What is in an encoded tree.
struct WideShape {
  std::size_t nodes = 0, node_bytes = 0, lanes = 0;  ///< inner nodes, bytes of all, children that one has room for
  std::size_t children = 0, triangles = 0;

  /// `topology_bytes`, `leaf_bytes`, and how full nodes are: `lane_fill`.
  std::vector<LayoutFact> facts(std::size_t bytes) const;
};

/// shape.facts() and how full leaves are.
std::vector<LayoutFact> wide_facts(const WideShape& shape, std::size_t bytes);

/// An encoded tree and its memory.
struct WideArena {
  Arena memory;
  WideView view;
  WideShape shape;

  std::size_t bytes() const { return memory.bytes(); }
  std::vector<LayoutFact> facts() const { return wide_facts(shape, bytes()); }
};

/// Most stack entries the kernels have room for; a deeper tree is not for them.
inline constexpr std::uint32_t wide_stack_limit = 448;

/// Encodes a tree over triangles of `mesh`: subtrees are contiguous, siblings adjacent, small leaves right behind their
/// siblings. Nothing when the kernels cannot trace it: a node has more than N children or a fixed order, or the tree is
/// deeper than wide_stack_limit. Two walks of the tree, each parallel; O(n), and no memory that grows with n but the
/// result.
template <int N, int L>
std::optional<WideArena> encode_wide(const Tree& tree, const Mesh& mesh);

/// Writes the same tree with other boxes, and the mesh with other positions, into the arena that was made for it.
template <int N, int L>
void refit_wide(WideArena& arena, const Tree& tree, const Mesh& mesh);

}  // namespace boxwood
