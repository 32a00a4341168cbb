#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include "boxwood/scene.h"
#include "layout/compressed/packed_leaf.h"
#include "layout/compressed/quantized_node.h"
#include "layout/simd/arena.h"
#include "layout/simd/wide_arena.h"
#include "tree/tree.h"

namespace boxwood {

struct SavedLevel;

/// A compressed tree: its nodes, and its leaves in words, packed or as names of triangles. Named triangles stay where
/// the mesh has them: it must outlive this.
struct QuantizedArena {
  Arena memory;
  std::span<const Vec3> positions;
  std::span<const Triangle> triangles;
  Box bounds;
  WideView view;
  WideShape shape;

  std::size_t bytes() const { return memory.bytes(); }
  std::vector<LayoutFact> facts() const { return shape.facts(bytes()); }
  /// Files hold the mesh as well, so that what is loaded needs no caller's. Copies it; O(n).
  void save(SavedLevel& out) const;
};

/// Bytes beside the mesh that leaves may bring a tree to by holding their own corners, per triangle, unless a recipe
/// says another number.
inline constexpr std::size_t bytes_per_triangle = 20;

/// Whether places of nodes and leaves fit 31 bits, of which references use the rest, and names of triangles 30. O(1).
bool has_quantized_names(const Tree& tree, const Mesh& mesh, std::size_t bytes);

/// The root is the first node but one.
constexpr WideReference quantized_root(std::size_t node_bytes) {
  return static_cast<WideReference>(node_bytes / sizeof(std::uint32_t) * 2);
}

WideView quantized_view(const std::byte* memory, std::size_t node_bytes, std::span<const Vec3> positions,
                        std::span<const Triangle> triangles);

/// Whether QuantizedNode8 can number what lies before the last leaf of every node. O(nodes).
bool fits_eight(const Tree& tree);

/// Encodes a tree of arity up to 8 or 16, by the node type, over the triangles of `mesh`. Throws UsageError when
/// nodes of eight are asked for and fits_eight() does not hold. Leaves hold their own corners, those first that have
/// most area for what that adds, as long as the whole takes no more than so many bytes per triangle; others name
/// triangles. O(n).
template <class Node>
QuantizedArena encode_quantized(const Tree& tree, const Mesh& mesh, std::size_t bytes = bytes_per_triangle);

}  // namespace boxwood
