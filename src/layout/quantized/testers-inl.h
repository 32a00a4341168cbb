// What the walk asks of quantized nodes; see layout/walk-inl.h. Compiled once per instruction set.
#if defined(BOXWOOD_LAYOUT_QUANTIZED_TESTERS_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef BOXWOOD_LAYOUT_QUANTIZED_TESTERS_INL_H
#undef BOXWOOD_LAYOUT_QUANTIZED_TESTERS_INL_H
#else
#define BOXWOOD_LAYOUT_QUANTIZED_TESTERS_INL_H
#endif

#include <cstddef>
#include <cstring>

#include "layout/bits/rank.h"
#include "layout/quantized/quantized_nodes.h"
#include "trace/prepared_ray-inl.h"

HWY_BEFORE_NAMESPACE();
namespace boxwood {
namespace HWY_NAMESPACE {

HWY_INLINE Link quantized_link(std::uint8_t axis, std::uint32_t first, std::uint32_t count, bool leaf) {
  Link link;
  link.first = first;
  link.count = count & Tree::max_count;
  link.leaf = leaf ? 1 : 0;
  link.axis = axis & 3;
  link.fixed_order = axis >> 2 & 1;
  return link;
}

HWY_INLINE Link numbered_leaf(const QuantizedChunks& nodes, std::uint32_t number) {
  const std::uint32_t* const offsets = nodes.leaf_offsets.data() + number;
  return quantized_link(Tree::mixed_axis, offsets[0], offsets[1] - offsets[0], true);
}

/// A node and its box as decoded, which its children's keys are relative to. Not initialized when declared, so that a
/// walk's stack costs nothing to make.
struct FramedSlot {
  std::uint32_t place;
  float lower[3], upper[3];

  HWY_INLINE static FramedSlot make(std::uint32_t place, const Box& box) {
    return {place, {box.lower.x, box.lower.y, box.lower.z}, {box.upper.x, box.upper.y, box.upper.z}};
  }
  HWY_INLINE Box box() const { return {{lower[0], lower[1], lower[2]}, {upper[0], upper[1], upper[2]}}; }
};

class PointerTester {
 public:
  using Slot = FramedSlot;
  PointerTester(const QuantizedPointers& nodes, const PreparedRay& ray)
      : root_(nodes.root_box), nodes_(nodes.nodes.data()), ray_(ray) {}

  const Box& root_box() const { return root_; }
  Slot root_slot() const { return Slot::make(0, decode(nodes_[0].key, root_)); }
  Link root_link() const { return link(root_slot()); }
  HWY_INLINE Link link(const Slot& slot) const {
    const PointerNode& node = nodes_[slot.place];
    return quantized_link(node.axis, node.first, node.count, node.count != 0);
  }
  static constexpr std::uint32_t children(const Link&) { return 2; }
  HWY_INLINE Slot slot_of(const Slot& slot, const Link& link, std::uint32_t child) const {
    const std::uint32_t place = child == 0 ? slot.place + 1 : link.first;
    return Slot::make(place, decode(nodes_[place].key, slot.box()));
  }
  HWY_INLINE bool test(const Slot& slot, const Link& link, std::uint32_t child, float from, float limit,
                       float& t) const {
    return hit_box(slot_of(slot, link, child).box(), ray_, from, limit, t);
  }

 private:
  const Box& root_;
  const PointerNode* nodes_;
  const PreparedRay& ray_;
};

/// Finds chunks, bits and links from places. With `two_bits`, of form `free`.
template <bool two_bits>
class ChunkReader {
 public:
  explicit ChunkReader(const QuantizedChunks& nodes)
      : nodes_(nodes), bit_bits_(nodes.bit_bits()), infos_(nodes.infos.data()) {}

  static constexpr std::uint32_t root_place = ~std::uint32_t{0};

  const QuantizedChunks& nodes() const { return nodes_; }
  std::uint32_t k() const { return nodes_.k; }
  HWY_INLINE const std::byte* chunk_of(std::uint32_t place) const {
    return nodes_.memory.data() + std::size_t{place >> bit_bits_} * nodes_.chunk_bytes;
  }
  HWY_INLINE static ChunkHeader header(const std::byte* chunk) {
    ChunkHeader header;
    std::memcpy(&header, chunk, sizeof header);
    return header;
  }
  HWY_INLINE Box frame(std::uint32_t place) const {
    Box box;
    std::memcpy(static_cast<void*>(&box), chunk_of(place), sizeof box);
    return box;
  }
  HWY_INLINE const NodeInfo& info(std::uint32_t place) const {
    return infos_[header(chunk_of(place)).first_node + bit_of(place)];
  }
  /// Whether the children of the node at `place`, which begin at `first`, lie in another chunk, or it is the root.
  HWY_INLINE bool leads_elsewhere(std::uint32_t place, std::uint32_t first) const {
    return place == root_place || place >> bit_bits_ != first >> bit_bits_;
  }
  HWY_INLINE Link link(std::uint32_t place) const {
    if (place == root_place) return nodes_.root;
    const std::byte* const chunk = chunk_of(place);
    const std::byte* const bits = chunk + sizeof(ChunkHeader);
    const ChunkHeader head = header(chunk);
    const std::uint32_t bit = bit_of(place);
    const std::uint32_t rank = rank_before<std::uint64_t>(bits, bit);
    std::uint32_t inner_before = rank, first;
    bool inner = test_bit(bits, bit);
    if constexpr (two_bits) {
      const std::byte* const elsewhere = bits + (nodes_.chunk_bytes - std::uint32_t{sizeof(ChunkHeader)}) / 2;
      const std::uint32_t rank_elsewhere = rank_before<std::uint64_t>(elsewhere, bit);
      first = inner ? children_here(place, rank) : (head.child_chunks + rank_elsewhere) << bit_bits_;
      inner = inner || test_bit(elsewhere, bit);
      inner_before += rank_elsewhere;
    } else {
      first = rank < nodes_.groups - 1 ? children_here(place, rank)
                                       : (head.child_chunks + rank - (nodes_.groups - 1)) << bit_bits_;
    }
    if (!inner) return numbered_leaf(nodes_, head.first_leaf + bit - inner_before);
    return quantized_link(infos_[head.first_node + bit].axis, first, nodes_.k, false);
  }

 private:
  HWY_INLINE std::uint32_t children_here(std::uint32_t place, std::uint32_t rank) const {
    return place >> bit_bits_ << bit_bits_ | nodes_.k * (rank + 1);
  }
  HWY_INLINE std::uint32_t bit_of(std::uint32_t place) const { return place & ((1u << bit_bits_) - 1); }

  const QuantizedChunks& nodes_;
  std::uint32_t bit_bits_;
  const NodeInfo* infos_;
};

/// Finds bits and links in one field with milestones. A place is the number of a bit.
class MilestoneReader {
 public:
  explicit MilestoneReader(const QuantizedChunks& nodes)
      : nodes_(nodes), memory_(nodes.memory.data()), infos_(nodes.infos.data()) {}

  static constexpr std::uint32_t root_place = ~std::uint32_t{0};

  const QuantizedChunks& nodes() const { return nodes_; }
  std::uint32_t k() const { return nodes_.k; }
  HWY_INLINE const NodeInfo& info(std::uint32_t place) const { return infos_[place]; }
  HWY_INLINE Box frame(std::uint32_t place) const {
    Box box;
    std::memcpy(static_cast<void*>(&box), memory_ + place / 64 * sizeof(QuantizedMilestone), sizeof box);
    return box;
  }
  HWY_INLINE Link link(std::uint32_t place) const {
    if (place == root_place) return nodes_.root;
    const std::byte* const at = memory_ + place / 64 * sizeof(QuantizedMilestone);
    std::uint64_t bits;
    std::uint32_t ones;
    std::memcpy(&bits, at + offsetof(QuantizedMilestone, bits), sizeof bits);
    std::memcpy(&ones, at + offsetof(QuantizedMilestone, ones_before), sizeof ones);
    const std::uint32_t rank = ones + count_ones(bits & ((std::uint64_t{1} << place % 64) - 1));
    if ((bits >> place % 64 & 1) == 0) return numbered_leaf(nodes_, place - rank);
    return quantized_link(infos_[place].axis, nodes_.k * (rank + 1), nodes_.k, false);
  }

 private:
  const QuantizedChunks& nodes_;
  const std::byte* memory_;
  const NodeInfo* infos_;
};

/// Keys relative to a box that the reader finds, its chunk's root or its run's union: every box can be decoded alone.
template <class Reader>
class FrameTester {
 public:
  using Slot = std::uint32_t;
  FrameTester(const QuantizedChunks& nodes, const PreparedRay& ray) : reader_(nodes), ray_(ray) {}

  const Box& root_box() const { return reader_.nodes().root_box; }
  static constexpr Slot root_slot() { return Reader::root_place; }
  const Link& root_link() const { return reader_.nodes().root; }
  HWY_INLINE Link link(Slot slot) const { return reader_.link(slot); }
  std::uint32_t children(const Link&) const { return reader_.k(); }
  HWY_INLINE static Slot slot_of(Slot, const Link& link, std::uint32_t child) { return link.first + child; }
  HWY_INLINE bool test(Slot slot, const Link& link, std::uint32_t child, float from, float limit, float& t) const {
    const Slot place = slot_of(slot, link, child);
    return hit_box(decode(reader_.info(place).key, reader_.frame(place)), ray_, from, limit, t);
  }

 private:
  Reader reader_;
  const PreparedRay& ray_;
};

using ChunkFrameTester = FrameTester<ChunkReader<false>>;
using FreeFrameTester = FrameTester<ChunkReader<true>>;
using MilestoneFrameTester = FrameTester<MilestoneReader>;

/// Keys relative to the parent's box as decoded, in a chunk's first group to the chunk's root.
class ParentFrameTester {
 public:
  using Slot = FramedSlot;
  ParentFrameTester(const QuantizedChunks& nodes, const PreparedRay& ray) : reader_(nodes), ray_(ray) {}

  const Box& root_box() const { return reader_.nodes().root_box; }
  Slot root_slot() const { return Slot::make(ChunkReader<false>::root_place, root_box()); }
  const Link& root_link() const { return reader_.nodes().root; }
  HWY_INLINE Link link(const Slot& slot) const { return reader_.link(slot.place); }
  std::uint32_t children(const Link&) const { return reader_.k(); }
  HWY_INLINE Slot slot_of(const Slot& slot, const Link& link, std::uint32_t child) const {
    const std::uint32_t place = link.first + child;
    const Box frame = reader_.leads_elsewhere(slot.place, place) ? reader_.frame(place) : slot.box();
    return Slot::make(place, decode(reader_.info(place).key, frame));
  }
  HWY_INLINE bool test(const Slot& slot, const Link& link, std::uint32_t child, float from, float limit,
                       float& t) const {
    return hit_box(slot_of(slot, link, child).box(), ray_, from, limit, t);
  }

 private:
  ChunkReader<false> reader_;
  const PreparedRay& ray_;
};

}  // namespace HWY_NAMESPACE
}  // namespace boxwood
HWY_AFTER_NAMESPACE();
#endif
