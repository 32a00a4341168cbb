#pragma once
#include <cstddef>
#include <cstdint>
#include <vector>

#include "layout/aligned_vector.h"
#include "layout/kernel_layout.h"
#include "layout/octree/octree_head.h"

namespace boxwood {

enum class BitForm : std::uint8_t {
  chunks,      ///< one bit per node in chunks of one subtree each, filled breadth first
  free,        ///< two bits per node: chunks are filled with whichever subtrees fit best
  milestones,  ///< one bit per node in one field, with a count of ones every 64 bits
  flat         ///< one bit per node in one field and nothing else
};
enum class ChunkBytes : std::uint8_t { b16, b32, b64, b128 };
enum class WordBits : std::uint8_t { w8, w16, w32, w64 };

struct BitOctreeOptions {
  BitForm form = BitForm::chunks;
  ChunkBytes chunk = ChunkBytes::b16;
  WordBits word = WordBits::w64;
  bool mailbox = true;

  std::uint32_t chunk_bytes() const { return 16u << static_cast<std::uint32_t>(chunk); }
};

/// Bytes before the bits of a chunk: child_chunks, first_leaf (see PlannedChunk), 32 bits each.
inline constexpr std::uint32_t octree_chunk_header = 8;

/// Groups of eight siblings that a chunk has room for.
constexpr std::uint32_t octree_chunk_groups(BitForm form, std::uint32_t chunk_bytes) {
  const std::uint32_t bytes = chunk_bytes - octree_chunk_header;
  return form == BitForm::free ? bytes / 2 : bytes;
}

/// 64 bits of one long field and how many ones come before them: 12 bytes, 1.5 bits per node.
struct [[gnu::packed]] Milestone {
  std::uint64_t bits = 0;
  std::uint32_t ones_before = 0;
};
static_assert(sizeof(Milestone) == 12);

/// An octree of one or two bits per node (spec 004, sections 2.3, 2.4 and 7.2). Nodes are in breadth-first order, of
/// each chunk or of all; the root is not stored: without other nodes it is a leaf. 1: inner node, 0: leaf. Memory:
///   chunks       C chunks of S bytes:  0 child_chunks u32   4 first_leaf u32   8 bits[S-8]
///   free         C chunks of S bytes:  0 child_chunks u32   4 first_leaf u32   8 here[(S-8)/2]   elsewhere[(S-8)/2]
///   milestones   Milestone for each 64 nodes
///   flat         64-bit words
struct BitOctreeNodes {
  OctreeHead head;
  BitForm form = BitForm::chunks;
  std::uint32_t chunk_bytes = 0;
  std::uint32_t groups = 0;  ///< a chunk has room for
  std::uint64_t chunks = 0;
  bool root_is_leaf = true;
  AlignedVector<std::byte> memory;          ///< with 8 bytes to spare, so that words may be read beyond the end
  std::vector<std::uint32_t> leaf_offsets;  ///< [k] … [k + 1]: the references of leaf k

  static constexpr std::size_t spare = 8;
  std::size_t topology_bytes() const { return memory.size() - spare; }
  std::size_t bytes() const {
    return topology_bytes() + leaf_offsets.size() * sizeof(std::uint32_t) + head.reference_bytes();
  }
  std::vector<LayoutFact> facts() const;
};

/// Makes the nodes; appends the leaves' references in the order in which leaves are numbered.
BitOctreeNodes encode_bit_octree(const OctreeTopology& topology, const Tree& tree, const BitOctreeOptions& options,
                                 OctreeReferences& references);

/// The fastest kernels this machine can run.
Kernels<BitOctreeNodes, TriangleLeaves> bit_octree_triangle_kernels(BitForm form, WordBits word);
Kernels<BitOctreeNodes, InstanceLeaves> bit_octree_instance_kernels(BitForm form, WordBits word);

}  // namespace boxwood
