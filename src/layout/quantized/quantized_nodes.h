#pragma once
#include <cstddef>
#include <cstdint>
#include <vector>

#include "boxwood/box.h"
#include "layout/aligned_vector.h"
#include "layout/kernel_layout.h"
#include "layout/link.h"
#include "layout/quantized/quantized_box.h"
#include "layout/trace_options.h"

namespace boxwood {

/// One node, 16 bytes, four per cache line (spec 004, section 2.6). Its key is relative to its parent's decoded box,
/// the root's to the world's:
///    0  key      QuantizedBox
///    6  count    references of a leaf; 0: inner node
///    8  first    first reference of a leaf; second child of an inner node, whose first child follows it
///   12  axis     bits 0-1 axis, bit 2 fixed_order, as in Tree::Node; 13-15 unused
struct PointerNode {
  QuantizedBox key;
  std::uint16_t count = 0;
  std::uint32_t first = 0;
  std::uint8_t axis = Tree::mixed_axis;
  std::uint8_t unused[3] = {};
};
static_assert(sizeof(PointerNode) == 16);

/// Binary, in depth-first order.
struct QuantizedPointers {
  Box root_box;
  AlignedVector<PointerNode> nodes;

  bool empty() const { return nodes.empty(); }
  std::size_t bytes() const { return nodes.size() * sizeof(PointerNode) + (empty() ? 0 : sizeof(Box)); }
};

/// Before the bits of a chunk, 40 bytes (spec 004, section 2.7.1):
///    0  box           of the chunk's implicit root, exact
///   24  child_chunks  first_leaf  first_node: see PlannedChunk; 36-39 unused
struct ChunkHeader {
  Box box;
  std::uint32_t child_chunks = 0, first_leaf = 0, first_node = 0, unused = 0;
};
static_assert(sizeof(ChunkHeader) == 40);

/// What is known of a node beside its bit, 7 bytes: its key, then its axis as in PointerNode.
struct NodeInfo {
  QuantizedBox key;
  std::uint8_t axis = Tree::mixed_axis;
};
static_assert(sizeof(NodeInfo) == 7);

/// 64 bits of one long field, how many ones come before them, and the union of the boxes of their nodes: 40 bytes, 5
/// bits per node (spec 004, section 7.2). 36-39 unused.
struct QuantizedMilestone {
  Box box;
  std::uint64_t bits = 0;
  std::uint32_t ones_before = 0, unused = 0;
};
static_assert(sizeof(QuantizedMilestone) == 40);

enum class QuantizedForm : std::uint8_t {
  chunks,      ///< one bit per node in chunks of one subtree each, filled breadth first
  free,        ///< two bits per node: chunks are filled with whichever parts of the subtree are chosen
  milestones,  ///< one bit per node in one field, with a count of ones and a frame every 64 bits
  pointers     ///< nodes of 16 bytes
};

/// One or two bits per node with keys beside them. Nodes have `k` children; where there are fewer, absent ones, leaves
/// without references whose key no ray meets, fill up. Memory:
///   chunks       C chunks of S bytes:  ChunkHeader, then bits[S-40]
///   free         C chunks of S bytes:  ChunkHeader, then here[(S-40)/2], elsewhere[(S-40)/2]
///   milestones   QuantizedMilestone for each 64 nodes
struct QuantizedChunks {
  QuantizedForm form = QuantizedForm::chunks;
  std::uint32_t k = 2;
  std::uint32_t chunk_bytes = 64;
  std::uint32_t groups = 0;  ///< a chunk has room for
  Box root_box;
  Link root;  ///< of a leaf: its references
  std::uint64_t chunks = 0;
  std::uint64_t absent = 0;                 ///< children that only fill up
  AlignedVector<std::byte> memory;          ///< with 8 bytes to spare, so that words may be read beyond the end
  std::vector<NodeInfo> infos;              ///< of all nodes but the root, in the order of their bits
  std::vector<std::uint32_t> leaf_offsets;  ///< [i] … [i + 1]: the references of leaf i

  static constexpr std::size_t spare = 8;
  /// A node's place: the number of its chunk, then the number of its bit.
  std::uint32_t bit_bits() const { return chunk_bytes == 64 ? 8 : 10; }
  bool empty() const { return root.count == 0; }
  std::size_t topology_bytes() const { return memory.size() - spare + infos.size() * sizeof(NodeInfo); }
  std::size_t bytes() const { return topology_bytes() + leaf_offsets.size() * sizeof(std::uint32_t); }
  std::vector<LayoutFact> facts() const;
};

enum class QuantizedFrame : std::uint8_t { chunk, parent };
enum class QuantizedChunkBytes : std::uint8_t { b64, b128 };
enum class QuantizedArity : std::uint8_t { k2, k4, k8 };
enum class QuantizedFill : std::uint8_t { visits, packed };

struct QuantizedOptions {
  QuantizedArity k = QuantizedArity::k2;
  QuantizedForm form = QuantizedForm::chunks;
  QuantizedFrame frame = QuantizedFrame::chunk;
  QuantizedChunkBytes chunk = QuantizedChunkBytes::b64;
  QuantizedFill fill = QuantizedFill::visits;

  std::uint32_t arity() const { return 2u << static_cast<std::uint32_t>(k); }
  std::uint32_t chunk_bytes() const { return 64u << static_cast<std::uint32_t>(chunk); }
};

/// Throws UsageError for nodes of more than two children, Error for leaves of more than 65535 references.
QuantizedPointers encode_quantized_pointers(const Tree& tree);
/// Permutes the tree's references to the order in which leaves are numbered. Throws UsageError for nodes of more than k
/// children, Error for trees of too many chunks.
QuantizedChunks encode_quantized_chunks(Tree& tree, const QuantizedOptions& options);

/// The fastest kernels this machine can run.
Kernels<QuantizedPointers, TriangleLeaves> quantized_pointer_triangle_kernels(const TraceOptions& trace);
Kernels<QuantizedPointers, InstanceLeaves> quantized_pointer_instance_kernels(const TraceOptions& trace);
Kernels<QuantizedChunks, TriangleLeaves> quantized_chunk_triangle_kernels(const TraceOptions& trace);
Kernels<QuantizedChunks, InstanceLeaves> quantized_chunk_instance_kernels(const TraceOptions& trace);
Kernels<QuantizedChunks, TriangleLeaves> quantized_free_triangle_kernels(const TraceOptions& trace);
Kernels<QuantizedChunks, InstanceLeaves> quantized_free_instance_kernels(const TraceOptions& trace);
Kernels<QuantizedChunks, TriangleLeaves> quantized_milestone_triangle_kernels(const TraceOptions& trace);
Kernels<QuantizedChunks, InstanceLeaves> quantized_milestone_instance_kernels(const TraceOptions& trace);
Kernels<QuantizedChunks, TriangleLeaves> quantized_parent_triangle_kernels(const TraceOptions& trace);
Kernels<QuantizedChunks, InstanceLeaves> quantized_parent_instance_kernels(const TraceOptions& trace);

}  // namespace boxwood
