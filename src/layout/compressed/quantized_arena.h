#pragma once
#include <cstdint>
#include <vector>

#include "boxwood/scene.h"
#include "layout/compressed/quantized_node.h"
#include "layout/simd/arena.h"
#include "layout/simd/wide_arena.h"
#include "tree/tree.h"

namespace boxwood {

/// A compressed tree: its nodes, and the names of its triangles leaf by leaf. The triangles stay where the mesh has
/// them: it must outlive this.
struct QuantizedArena {
  Arena nodes;
  std::vector<std::uint32_t> primitives;
  WideView view;

  std::size_t bytes() const { return nodes.bytes() + primitives.capacity() * sizeof(std::uint32_t); }
};

/// Encodes a tree of arity up to 8 or 16, by the node type, over the triangles of `mesh`. Throws UsageError when the
/// leaves of one node hold more than its bytes can number, which only nodes of eight do. O(n).
template <class Node>
QuantizedArena encode_quantized(const Tree& tree, const Mesh& mesh);

}  // namespace boxwood
