// Where rays in flight live: slots of a ray's state with its stack, and lists of slots by what their rays need next.
// Compiled once per instruction set that has eight lanes.
#if defined(BOXWOOD_LAYOUT_SIMD_SLOTS_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef BOXWOOD_LAYOUT_SIMD_SLOTS_INL_H
#undef BOXWOOD_LAYOUT_SIMD_SLOTS_INL_H
#else
#define BOXWOOD_LAYOUT_SIMD_SLOTS_INL_H
#endif

#include <bit>
#include <cstddef>

#include "layout/simd/compress-inl.h"
#include "layout/simd/triangles-inl.h"
#include "layout/simd/wide_arena.h"

HWY_BEFORE_NAMESPACE();
namespace boxwood {
namespace HWY_NAMESPACE {
#if HWY_MAX_BYTES >= 32

/// Rays in flight of one call, and the memory for their slots: some live on the caller's stack.
inline constexpr int most_in_flight = 96;
inline constexpr std::size_t slot_memory = std::size_t{192} << 10;

/// Entries read below the top of a stack or written above it at once.
inline constexpr std::uint32_t stack_margin = 16;
/// The bottom of every stack: below it are entries that are never reached.
inline constexpr std::uint32_t stack_bottom = 8;

/// A child on the stack of a ray in flight. Its key is the entry distance as an integer, with the lane in its low bits.
struct alignas(8) StackEntry {
  WideReference reference;
  std::int32_t key;
};

/// What a ray in flight needs, by cache line: what node steps read, what leaf steps read. Its stack follows: entries,
/// or references alone where it is only asked whether the ray is blocked.
struct alignas(64) Slot {
  float inverse[3], near_offset[3], far_offset[3];
  float t_near;
  float t_limit;              // t_far or the best hit so far
  std::uint16_t near_row[3];  // byte offsets of the near planes in a node
  std::uint16_t fetched;      // steps that the triangles of its leaf are under way (../compressed/packed_pass-inl.h)
  WideReference next;
  void* top;  // behind the topmost entry of the stack

  TriangleRay leaf;
  Hit best;
  std::uint32_t index;  // of the ray in the batch
};
static_assert(sizeof(Slot) == 128);

/// The bottom of a slot's stack of entries, or of references.
template <class Entry>
HWY_INLINE Entry* bottom_of(Slot& slot) {
  return reinterpret_cast<Entry*>(&slot + 1) + stack_bottom;
}
template <class Entry>
HWY_INLINE Entry* top_of(const Slot& slot) {
  return static_cast<Entry*>(slot.top);
}

/// Of a stack of references that ends at `end` takes the last; there is always one.
HWY_INLINE WideReference take_last(WideReference* end, Slot& slot) {
  slot.top = end - 1;
  return slot.next = end[-1];
}

/// Slots side by side, each with room for a stack of `capacity` entries. The stride is an odd number of cache lines, so
/// that slots do not compete for the same sets of the cache.
class Slots {
 public:
  Slots(std::byte* memory, std::uint32_t stack) : memory_(memory) {
    std::size_t lines = (sizeof(Slot) + (stack + 2 * stack_margin) * sizeof(StackEntry) + 63) / 64;
    lines |= 1;
    stride_ = lines * 64;
  }
  int in_flight() const {
    const std::size_t fit = slot_memory / stride_;
    return fit < most_in_flight ? static_cast<int>(fit) : most_in_flight;
  }
  HWY_INLINE Slot& at(std::uint32_t offset) const { return *reinterpret_cast<Slot*>(memory_ + offset); }
  HWY_INLINE std::uint32_t offset(int index) const {
    return static_cast<std::uint32_t>(stride_) * static_cast<std::uint32_t>(index);
  }

 private:
  std::byte* memory_;
  std::size_t stride_ = 0;
};

/// Offsets of slots. Room for whole vectors behind the end.
struct SlotList {
  alignas(64) std::uint32_t offsets[most_in_flight + 16];
  std::uint32_t size = 0;

  HWY_INLINE void add(std::uint32_t offset) { offsets[size++] = offset; }
  /// At most eight; eight are read.
  HWY_INLINE void add(const std::uint32_t* more, std::uint32_t count) {
    const Words8 d;
    hn::StoreU(hn::LoadU(d, more), d, offsets + size);
    size += count;
  }
  HWY_INLINE void add_all(const Slots& slots) {
    for (int i = 0; i < slots.in_flight(); ++i) add(slots.offset(i));
  }
  /// Behind the end, so that an odd last one has a partner.
  HWY_INLINE void repeat_last() { offsets[size] = offsets[size - 1]; }
};

HWY_INLINE void append(SlotList& from, SlotList& to) {
  const WidestWords d;
  for (std::uint32_t i = 0; i < from.size; i += lanes_of<WidestWords>) {
    hn::StoreU(hn::Load(d, from.offsets + i), d, to.offsets + to.size + i);
  }
  to.size += from.size;
  from.size = 0;
}

/// Sorts what a pass left in `list` into nodes, leaves and the rest by `next`, the references in the same order.
/// `list` may be that of `nodes`, emptied: lanes are read before anything is written over them.
HWY_INLINE void split(const std::uint32_t* list, std::uint32_t length, const std::uint32_t* next, SlotList& nodes,
                      SlotList& leaves, SlotList& rest) {
  const WidestWords d;
  const hn::RebindToSigned<WidestWords> di;
  constexpr int lanes = lanes_of<WidestWords>;
  const int size = static_cast<int>(length);
  std::uint32_t node_count = nodes.size, leaf_count = leaves.size, rest_count = rest.size;
  const auto lane = hn::Iota(di, 0);
  for (int i = 0; i < size; i += lanes) {
    const auto offsets = hn::Load(d, list + i);
    const auto references = hn::Load(d, next + i);
    const auto in_use = hn::RebindMask(d, hn::Lt(lane, hn::Set(di, size - i)));
    const auto leaf = hn::TestBit(references, hn::Set(d, 1));
    const auto none = hn::Eq(hn::AndNot(hn::Set(d, 1), references), hn::Zero(d));
    const auto is_node = hn::And(in_use, hn::Not(hn::Or(leaf, none)));
    node_count += compress_store<WidestWords>(offsets, is_node, nodes.offsets + node_count);
    leaf_count +=
        compress_store<WidestWords>(offsets, hn::And(in_use, hn::AndNot(none, leaf)), leaves.offsets + leaf_count);
    rest_count += compress_store<WidestWords>(offsets, hn::And(in_use, none), rest.offsets + rest_count);
  }
  nodes.size = node_count;
  leaves.size = leaf_count;
  rest.size = rest_count;
}

#endif  // HWY_MAX_BYTES >= 32
}  // namespace HWY_NAMESPACE
}  // namespace boxwood
HWY_AFTER_NAMESPACE();
#endif
