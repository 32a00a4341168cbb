// How a walk finds its way through an octree of bits; spec 004, section 2.4.4. Everything is inlined by force, so that
// a kernel counts bits with its own instruction set.
#pragma once
#include <hwy/base.h>

#include <cstring>

#include "layout/bits/rank.h"
#include "layout/octree/bit_octree_nodes.h"

namespace boxwood {

/// What all navigators of bits share. A node is a bit of a chunk; of forms without chunks, chunk 0.
class BitNavigator {
 public:
  struct Node {
    std::uint32_t chunk, bit;
  };
  explicit BitNavigator(const BitOctreeNodes& nodes)
      : memory_(nodes.memory.data()),
        offsets_(nodes.leaf_offsets.data()),
        chunk_bytes_(nodes.chunk_bytes),
        groups_(nodes.groups),
        root_is_leaf_(nodes.root_is_leaf) {}

  static constexpr Node root() { return {0, root_bit}; }
  /// Only its leaf number tells whether a leaf holds anything.
  static constexpr bool is_empty(const Node&) { return false; }
  HWY_INLINE static Node child(const Node& first, std::uint32_t octant) { return {first.chunk, first.bit + octant}; }

 protected:
  static constexpr std::uint32_t root_bit = ~std::uint32_t{0};

  HWY_INLINE OctreeLeaf numbered_leaf(std::uint32_t number) const {
    return {offsets_[number], offsets_[number + 1] - offsets_[number]};
  }
  HWY_INLINE const std::byte* chunk(std::uint32_t number) const { return memory_ + std::size_t{number} * chunk_bytes_; }
  HWY_INLINE static std::uint32_t child_chunks(const std::byte* chunk) { return field(chunk); }
  HWY_INLINE static std::uint32_t first_leaf(const std::byte* chunk) { return field(chunk + 4); }
  HWY_INLINE static std::uint32_t field(const std::byte* at) {
    std::uint32_t value;
    std::memcpy(&value, at, sizeof value);
    return value;
  }

  const std::byte* memory_;
  const std::uint32_t* offsets_;
  std::uint32_t chunk_bytes_, groups_;
  bool root_is_leaf_;
};

/// One bit per node, counted in words of type Word: the first groups - 1 ones have their children in the chunk.
template <class Word>
class ChunkNavigator : public BitNavigator {
 public:
  using BitNavigator::BitNavigator;
  HWY_INLINE bool is_leaf(const Node& node) const {
    return node.bit == root_bit ? root_is_leaf_ : !test_bit(chunk(node.chunk) + octree_chunk_header, node.bit);
  }
  HWY_INLINE OctreeLeaf leaf(const Node& node) const {
    if (node.bit == root_bit) return numbered_leaf(0);
    const std::byte* const at = chunk(node.chunk);
    return numbered_leaf(first_leaf(at) + node.bit - rank_before<Word>(at + octree_chunk_header, node.bit));
  }
  HWY_INLINE Node children(const Node& node) const {
    if (node.bit == root_bit) return {0, 0};
    const std::byte* const at = chunk(node.chunk);
    const std::uint32_t rank = rank_before<Word>(at + octree_chunk_header, node.bit);
    if (rank < groups_ - 1) return {node.chunk, 8 * (rank + 1)};
    return {child_chunks(at) + rank - (groups_ - 1), 0};
  }
};

/// Two bits per node, in two fields: inner nodes with their children here, and elsewhere.
class FreeNavigator : public BitNavigator {
 public:
  using BitNavigator::BitNavigator;
  HWY_INLINE bool is_leaf(const Node& node) const {
    if (node.bit == root_bit) return root_is_leaf_;
    const std::byte* const at = chunk(node.chunk);
    return !test_bit(here(at), node.bit) && !test_bit(elsewhere(at), node.bit);
  }
  HWY_INLINE OctreeLeaf leaf(const Node& node) const {
    if (node.bit == root_bit) return numbered_leaf(0);
    const std::byte* const at = chunk(node.chunk);
    return numbered_leaf(first_leaf(at) + node.bit - rank_before<std::uint64_t>(here(at), node.bit) -
                         rank_before<std::uint64_t>(elsewhere(at), node.bit));
  }
  HWY_INLINE Node children(const Node& node) const {
    if (node.bit == root_bit) return {0, 0};
    const std::byte* const at = chunk(node.chunk);
    if (test_bit(here(at), node.bit)) {
      return {node.chunk, 8 * (rank_before<std::uint64_t>(here(at), node.bit) + 1)};
    }
    return {child_chunks(at) + rank_before<std::uint64_t>(elsewhere(at), node.bit), 0};
  }

 private:
  HWY_INLINE static const std::byte* here(const std::byte* chunk) { return chunk + octree_chunk_header; }
  HWY_INLINE const std::byte* elsewhere(const std::byte* chunk) const { return chunk + octree_chunk_header + groups_; }
};

/// One field for the whole tree.
template <bool milestones>
class FieldNavigator : public BitNavigator {
 public:
  using BitNavigator::BitNavigator;
  HWY_INLINE bool is_leaf(const Node& node) const {
    return node.bit == root_bit ? root_is_leaf_ : (word(node.bit / 64) >> node.bit % 64 & 1) == 0;
  }
  HWY_INLINE OctreeLeaf leaf(const Node& node) const {
    return numbered_leaf(node.bit == root_bit ? 0 : node.bit - rank(node.bit));
  }
  HWY_INLINE Node children(const Node& node) const { return {0, node.bit == root_bit ? 0 : 8 * (rank(node.bit) + 1)}; }

 private:
  static constexpr std::size_t stride = milestones ? sizeof(Milestone) : sizeof(std::uint64_t);

  HWY_INLINE std::uint64_t word(std::uint32_t number) const {
    std::uint64_t bits;
    std::memcpy(&bits, memory_ + number * stride, sizeof bits);
    return bits;
  }
  HWY_INLINE std::uint32_t rank(std::uint32_t bit) const {
    std::uint32_t ones = 0;
    if constexpr (milestones) {
      ones = field(memory_ + bit / 64 * stride + sizeof(std::uint64_t));
    } else {
      for (std::uint32_t w = 0; w < bit / 64; ++w) ones += count_ones(word(w));
    }
    const std::uint64_t before = word(bit / 64) & ((std::uint64_t{1} << bit % 64) - 1);
    return ones + count_ones(before);
  }
};

}  // namespace boxwood
