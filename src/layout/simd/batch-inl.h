// Many rays in flight: every ray waits in one of three lists for what it needs next (a node, a leaf, an entry popped
// from its stack), and each pass serves a whole list with steps free of data-dependent branches. So neither cache
// misses nor mispredictions of one ray hold up the others. Needs eight-lane registers. Compiled once per instruction
// set.
#if defined(BOXWOOD_LAYOUT_SIMD_BATCH_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef BOXWOOD_LAYOUT_SIMD_BATCH_INL_H
#undef BOXWOOD_LAYOUT_SIMD_BATCH_INL_H
#else
#define BOXWOOD_LAYOUT_SIMD_BATCH_INL_H
#endif

#include <span>

#include "layout/simd/compress8-inl.h"
#include "layout/simd/single-inl.h"
#include "layout/simd/sort8-inl.h"

HWY_BEFORE_NAMESPACE();
namespace boxwood {
namespace HWY_NAMESPACE {
#if HWY_MAX_BYTES >= 32

using Floats8 = hn::FixedTag<float, 8>;
using Ints8 = hn::FixedTag<std::int32_t, 8>;

/// Rays in flight of one call, and the memory for their slots: some live on the caller's stack.
inline constexpr int most_in_flight = 32;
inline constexpr std::size_t slot_memory = std::size_t{160} << 10;

/// What a ray in flight needs, by cache line: what node steps read, what leaf steps read. Its stack follows: keys, then
/// references. A key is the entry distance as an integer with the lane in its low three bits.
struct alignas(64) Slot {
  float inverse[3], near_offset[3], far_offset[3];
  float t_near;
  float t_limit;              // t_far or the best hit so far
  std::uint32_t near_row[3];  // byte offsets of the near planes in a node
  WideReference next;
  std::uint32_t top;  // entries on the stack

  PreparedRay ray;
  Hit best;
  std::uint32_t index;  // of the ray in the batch
};

HWY_INLINE std::int32_t* keys_of(Slot& slot) { return reinterpret_cast<std::int32_t*>(&slot + 1); }

/// Slots side by side, each with room for a stack of `capacity` entries. The stride is an odd number of cache lines, so
/// that slots do not compete for the same sets of the cache.
class Slots {
 public:
  Slots(std::byte* memory, std::uint32_t stack) : memory_(memory) {
    // Whole vectors are stored above the top and read below the bottom.
    capacity_ = (stack + 8 + 8 + 7) & ~7u;
    std::size_t lines = (sizeof(Slot) + capacity_ * std::size_t{8} + 63) / 64;
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
  HWY_INLINE std::int32_t* keys(Slot& slot) const { return keys_of(slot); }
  HWY_INLINE WideReference* references(Slot& slot) const {
    return reinterpret_cast<WideReference*>(keys_of(slot) + capacity_);
  }

 private:
  std::byte* memory_;
  std::uint32_t capacity_ = 0;
  std::size_t stride_ = 0;
};

/// Offsets of slots. Room for whole vectors behind the end.
struct SlotList {
  alignas(64) std::uint32_t offsets[most_in_flight + 16];
  std::uint32_t size = 0;

  HWY_INLINE void add(std::uint32_t offset) { offsets[size++] = offset; }
};

HWY_INLINE std::uint32_t float_bits(float value) { return std::bit_cast<std::uint32_t>(value); }

/// The bottom of every stack: below it 8 entries that are never reached.
inline constexpr std::uint32_t stack_bottom = 8;

template <bool Closest>
HWY_INLINE void start(const Slots& slots, Slot& slot, const WideView& view, const PreparedRay& ray, std::size_t index) {
  for (int axis = 0; axis < 3; ++axis) {
    slot.inverse[axis] = ray.inverse[axis];
    slot.near_offset[axis] = ray.near_offset[axis];
    slot.far_offset[axis] = ray.far_offset[axis];
    slot.near_row[axis] = static_cast<std::uint32_t>(2 * axis + ray.negative[axis]) * 32;
  }
  slot.t_near = ray.t_near + 0.0f;  // never -0: keys and limits are compared as integers
  slot.t_limit = ray.t_far + 0.0f;
  slot.next = view.root;
  slot.top = stack_bottom + 1;
  slot.ray = ray;
  slot.best = Hit{};
  slot.index = static_cast<std::uint32_t>(index);
  slots.references(slot)[stack_bottom] = wide_finished;
  if constexpr (Closest) slots.keys(slot)[stack_bottom] = -1;
}

struct NodeHits {
  hn::Vec<Floats8> entry;
  hn::Mask<Floats8> hit;
};

HWY_INLINE NodeHits hit_node(const std::byte* node, const Slot& slot) {
  const Floats8 d;
  const auto plane = [&](std::uint32_t row, int axis, float offset) {
    return hn::MulSub(hn::Load(d, reinterpret_cast<const float*>(node + row)), hn::Set(d, slot.inverse[axis]),
                      hn::Set(d, offset));
  };
  const std::uint32_t x = slot.near_row[0], y = slot.near_row[1], z = slot.near_row[2];
  const auto entry = hn::Max(hn::Max(plane(x, 0, slot.near_offset[0]), plane(y, 1, slot.near_offset[1])),
                             hn::Max(plane(z, 2, slot.near_offset[2]), hn::Set(d, slot.t_near)));
  const auto exit = hn::Min(hn::Min(plane(x ^ 32, 0, slot.far_offset[0]), plane(y ^ 32, 1, slot.far_offset[1])),
                            hn::Min(plane(z ^ 32, 2, slot.far_offset[2]), hn::Set(d, slot.t_limit)));
  return {entry, hn::Le(entry, exit)};
}

HWY_INLINE void prefetch_next(const WideView& view, WideReference reference) {
  const std::byte* place = view.base + std::size_t{reference} * 16;
  __builtin_prefetch(place);
  __builtin_prefetch(place + 64);
  __builtin_prefetch(place + 128);
  __builtin_prefetch(place + 192);
}

/// Closest hit: pushes all children met, nearest on top, and takes the top; nothing when none was met. One step of some
/// 80 instructions: cut into three shorter passes it was a tenth slower.
template <bool Prefetch>
HWY_INLINE WideReference closest_node_step(const Slots& slots, const WideView& view, Slot& slot) {
  const Floats8 d;
  const Ints8 di;
  const Words8 dw;
  const std::byte* node = view.base + std::size_t{slot.next} * 16;
  const NodeHits hits = hit_node(node, slot);
  // Missed children become the least of all keys: they end behind the others and are never read.
  const auto key = hn::Or(hn::And(hn::BitCast(di, hits.entry), hn::Set(di, ~7)), hn::Iota(di, 0));
  const auto miss = hn::Set(di, std::numeric_limits<std::int32_t>::min());
  const auto sorted = sort8_descending(hn::IfThenElse(hn::RebindMask(di, hits.hit), key, miss));
  const auto children = hn::Load(dw, reinterpret_cast<const std::uint32_t*>(node + 6 * 32));
  const auto lanes = hn::IndicesFromVec(dw, hn::BitCast(dw, hn::And(sorted, hn::Set(di, 7))));
  const std::uint32_t top = slot.top;
  WideReference* references = slots.references(slot);
  hn::StoreU(sorted, di, slots.keys(slot) + top);
  hn::StoreU(hn::TableLookupLanes(children, lanes), dw, references + top);
  const std::uint32_t bits = bits_of(d, hits.hit);
  const std::uint32_t some = (bits + 0xff) >> 8;  // 1 when any was met; arithmetic, lest the compiler make a branch
  slot.top = top + static_cast<std::uint32_t>(std::popcount(bits)) - some;
  const WideReference next = references[slot.top] & (0u - some);
  slot.next = next;
  if constexpr (Prefetch) prefetch_next(view, next);
  return next;
}

/// Closest hit: takes the topmost entry that is not behind the limit, eight looked at at once.
HWY_INLINE WideReference pop_step(const Slots& slots, Slot& slot) {
  const Ints8 di;
  const auto limit = hn::Set(di, static_cast<std::int32_t>(float_bits(slot.t_limit) | 7));
  const std::int32_t* keys = slots.keys(slot);
  std::uint32_t top = slot.top;
  std::uint32_t keep = 0;
  while (true) {
    keep = ~bits_of(di, hn::Gt(hn::LoadU(di, keys + top - 8), limit)) & 0xff;
    if (HWY_LIKELY(keep != 0)) break;
    top -= 8;
  }
  top = top - 8 + static_cast<std::uint32_t>(std::bit_width(keep)) - 1;
  slot.top = top;
  slot.next = slots.references(slot)[top];
  return slot.next;
}

template <int L>
HWY_INLINE void closest_leaf_step(const WideView& view, Slot& slot) {
  const LeafBlock<L>* block = blocks_at<L>(view, slot.next);
  bool more = true;
  for (; more; ++block) {
    if (closest_in_block(*block, slot.ray, slot.t_limit, slot.best)) slot.t_limit = slot.best.t + 0.0f;
    more = (block->primitives[0] & more_blocks) != 0;
  }
}

/// Sorts what a pass left in `list` into nodes, leaves and the rest by `next`, the references in the same order.
/// `list` may be that of `nodes`, emptied: lanes are read before anything is written over them.
HWY_INLINE void split(const std::uint32_t* list, std::uint32_t length, const std::uint32_t* next, SlotList& nodes,
                      SlotList& leaves, SlotList& rest) {
  const Words8 d;
  const int size = static_cast<int>(length);
  std::uint32_t node_count = nodes.size, leaf_count = leaves.size, rest_count = rest.size;
  const auto lane = hn::Iota(Ints8(), 0);
  for (int i = 0; i < size; i += 8) {
    const auto offsets = hn::Load(d, list + i);
    const auto references = hn::Load(d, next + i);
    const auto used = hn::Lt(lane, hn::Set(Ints8(), size - i));
    const auto in_use = hn::RebindMask(d, used);
    const auto leaf = hn::TestBit(references, hn::Set(d, 1));
    const auto none = hn::Eq(hn::AndNot(hn::Set(d, 1), references), hn::Zero(d));
    const auto is_node = hn::And(in_use, hn::Not(hn::Or(leaf, none)));
    node_count += compress_store(offsets, is_node, nodes.offsets + node_count);
    leaf_count += compress_store(offsets, hn::And(in_use, hn::AndNot(none, leaf)), leaves.offsets + leaf_count);
    rest_count += compress_store(offsets, hn::And(in_use, none), rest.offsets + rest_count);
  }
  nodes.size = node_count;
  leaves.size = leaf_count;
  rest.size = rest_count;
}

/// Closest hits of a whole batch.
template <int L, bool Prefetch>
class ClosestBatch {
 public:
  ClosestBatch(const WideView& view, std::span<const Ray> rays, std::span<Hit> hits, std::byte* memory)
      : view_(view), rays_(rays), hits_(hits), slots_(memory, view.stack) {}

  void run() {
    const int in_flight = slots_.in_flight();
    for (int i = 0; i < in_flight; ++i) load(slots_.offset(i));
    while (nodes_.size + leaves_.size + pops_.size > 0) {
      if (nodes_.size >= leaves_.size && nodes_.size >= pops_.size)
        node_pass();
      else if (pops_.size >= leaves_.size)
        pop_pass();
      else
        leaf_pass();
    }
  }

 private:
  /// Puts the next ray that the lists can serve into a slot; none when the batch is done.
  void load(std::uint32_t offset) {
    for (; next_ray_ < rays_.size(); ++next_ray_) {
      const PreparedRay ray = prepare(rays_[next_ray_], view_.reach);
      // Keys order by their bits, which negative distances do not do.
      if (HWY_UNLIKELY(!ray.valid || ray.t_near < 0)) {
        hits_[next_ray_] = closest_hit<8, L>(view_, ray, CountNothing{});
        continue;
      }
      start<true>(slots_, slots_.at(offset), view_, ray, next_ray_++);
      nodes_.add(offset);
      return;
    }
  }

  void node_pass() {
    const std::uint32_t size = nodes_.size;
    for (std::uint32_t i = 0; i < size; ++i) {
      next_[i] = closest_node_step<Prefetch>(slots_, view_, slots_.at(nodes_.offsets[i]));
    }
    nodes_.size = 0;
    split(nodes_.offsets, size, next_, nodes_, leaves_, pops_);
  }

  void leaf_pass() {
    for (std::uint32_t i = 0; i < leaves_.size; ++i) {
      closest_leaf_step<L>(view_, slots_.at(leaves_.offsets[i]));
      pops_.offsets[pops_.size + i] = leaves_.offsets[i];
    }
    pops_.size += leaves_.size;
    leaves_.size = 0;
  }

  void pop_pass() {
    finished_.size = 0;
    for (std::uint32_t i = 0; i < pops_.size; ++i) {
      Slot& slot = slots_.at(pops_.offsets[i]);
      next_[i] = pop_step(slots_, slot);
      if constexpr (Prefetch) prefetch_next(view_, next_[i]);
    }
    split(pops_.offsets, pops_.size, next_, nodes_, leaves_, finished_);
    pops_.size = 0;
    for (std::uint32_t i = 0; i < finished_.size; ++i) {
      const Slot& slot = slots_.at(finished_.offsets[i]);
      hits_[slot.index] = slot.best;
      load(finished_.offsets[i]);
    }
  }

  const WideView& view_;
  std::span<const Ray> rays_;
  std::span<Hit> hits_;
  Slots slots_;
  std::size_t next_ray_ = 0;
  SlotList nodes_, leaves_, pops_, finished_;
  alignas(64) std::uint32_t next_[most_in_flight + 16];
};

/// Any hits of a whole batch: no order, no distances; the top of the stack is always what comes next.
template <int L, bool Prefetch>
class AnyBatch {
 public:
  AnyBatch(const WideView& view, std::span<const Ray> rays, std::span<std::uint8_t> blocked, std::byte* memory)
      : view_(view), rays_(rays), blocked_(blocked), slots_(memory, view.stack) {}

  void run() {
    const int in_flight = slots_.in_flight();
    for (int i = 0; i < in_flight; ++i) load(slots_.offset(i));
    while (nodes_.size + leaves_.size > 0) {
      if (nodes_.size >= leaves_.size)
        node_pass();
      else
        leaf_pass();
      for (std::uint32_t i = 0; i < finished_.size; ++i) load(finished_.offsets[i]);
      finished_.size = 0;
    }
  }

 private:
  void load(std::uint32_t offset) {
    for (; next_ray_ < rays_.size(); ++next_ray_) {
      const PreparedRay ray = prepare(rays_[next_ray_], view_.reach);
      blocked_[next_ray_] = 0;
      if (HWY_UNLIKELY(!ray.valid)) continue;
      start<false>(slots_, slots_.at(offset), view_, ray, next_ray_++);
      nodes_.add(offset);
      return;
    }
  }

  HWY_INLINE WideReference node_step(Slot& slot) {
    const Words8 dw;
    const std::byte* node = view_.base + std::size_t{slot.next} * 16;
    const NodeHits hits = hit_node(node, slot);
    const auto children = hn::Load(dw, reinterpret_cast<const std::uint32_t*>(node + 6 * 32));
    WideReference* references = slots_.references(slot);
    slot.top += compress_store(children, hn::RebindMask(dw, hits.hit), references + slot.top) - 1;
    slot.next = references[slot.top];
    if constexpr (Prefetch) prefetch_next(view_, slot.next);
    return slot.next;
  }

  void node_pass() {
    SlotList list = nodes_;
    nodes_.size = 0;
    for (std::uint32_t i = 0; i < list.size; ++i) next_[i] = node_step(slots_.at(list.offsets[i]));
    split(list.offsets, list.size, next_, nodes_, leaves_, finished_);
  }

  HWY_INLINE WideReference leaf_step(Slot& slot) {
    const LeafBlock<L>* block = blocks_at<L>(view_, slot.next);
    bool more = true;
    for (; more; ++block) {
      if (any_in_block(*block, slot.ray)) {
        blocked_[slot.index] = 1;
        return wide_finished;
      }
      more = (block->primitives[0] & more_blocks) != 0;
    }
    slot.next = slots_.references(slot)[--slot.top];
    if constexpr (Prefetch) prefetch_next(view_, slot.next);
    return slot.next;
  }

  void leaf_pass() {
    SlotList list = leaves_;
    leaves_.size = 0;
    for (std::uint32_t i = 0; i < list.size; ++i) next_[i] = leaf_step(slots_.at(list.offsets[i]));
    split(list.offsets, list.size, next_, nodes_, leaves_, finished_);
  }

  const WideView& view_;
  std::span<const Ray> rays_;
  std::span<std::uint8_t> blocked_;
  Slots slots_;
  std::size_t next_ray_ = 0;
  SlotList nodes_, leaves_, finished_;
  alignas(64) std::uint32_t next_[most_in_flight + 16];
};

#endif  // HWY_MAX_BYTES >= 32
}  // namespace HWY_NAMESPACE
}  // namespace boxwood
HWY_AFTER_NAMESPACE();
#endif
