// Any hits by streams: rays of one octant (the signs of their directions) walk the tree together, each node with the
// list of those that enter it. A node is fetched, unpacked and its planes chosen once for all of them, no ray has a
// stack of its own, and rays that are blocked drop out. After Barringer and Akenine-Moeller 2014, "Dynamic Ray Stream
// Traversal". Compiled once per instruction set that has eight lanes.
#if defined(BOXWOOD_LAYOUT_SIMD_STREAM_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef BOXWOOD_LAYOUT_SIMD_STREAM_INL_H
#undef BOXWOOD_LAYOUT_SIMD_STREAM_INL_H
#else
#define BOXWOOD_LAYOUT_SIMD_STREAM_INL_H
#endif

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <span>

#include "layout/simd/leaf_steps-inl.h"
#include "layout/simd/load_rays-inl.h"
#include "layout/simd/ray_pairs-inl.h"
#include "layout/simd/single-inl.h"
#include "layout/simd/slots-inl.h"

HWY_BEFORE_NAMESPACE();
namespace boxwood {
namespace HWY_NAMESPACE {
#if HWY_MAX_BYTES >= 32

inline constexpr std::uint32_t most_in_stream = 1024;
/// Rays gathered by octant at a time.
inline constexpr std::size_t stream_block = 2048;
/// At nodes that no more of a stream's rays enter they go on by themselves: to open one costs as much as the steps of
/// some rays.
inline constexpr std::uint32_t few_rays = 4;
/// Entries of the lists of a stream's nodes. Nodes whose lists have no room go ray by ray.
inline constexpr std::uint32_t stream_entries = 16384;
/// Entries that a list takes: whole vectors are written behind its end.
constexpr std::uint32_t room_for(std::uint32_t size) { return (size + 31) & ~15u; }

/// A node that a stream has not been to yet, and its part of the lists: the rays that enter it.
struct StreamNode {
  WideReference reference;
  std::uint32_t begin, size;
};

/// Rays with leaves that they enter, waiting for their tests: those of several leaves go into one loop, since few rays
/// share a leaf and the end of a loop of two or three rounds is mispredicted as often as not.
template <class Store>
struct LeafQueue {
  /// At the end of a node, tests are made when so many wait: later, and more would be made of rays that are blocked.
  static constexpr std::uint32_t enough = 12;
  /// So many are made in any case.
  static constexpr std::uint32_t most = 256;
  static constexpr std::uint32_t capacity = most + most_in_stream + 32;  // whole vectors are written behind the end

  std::uint32_t size = 0, leaves = 0;
  alignas(64) std::uint32_t rays[capacity];  // offsets of slots
  alignas(64) WideReference references[capacity];
  alignas(64) const LeafBlock<Store::triangles>* blocks[capacity];  // the first of the leaf
  typename Store::BlockBuffer buffers[most];                        // of each leaf

  /// Has the last `count` of `rays` wait for a leaf.
  HWY_INLINE void add(const WideView& view, WideReference leaf, std::uint32_t count) {
    const WidestWords words;
    const hn::Repartition<std::uint64_t, WidestWords> pointers;
    const auto reference = hn::Set(words, leaf);
    const auto block =
        hn::Set(pointers, reinterpret_cast<std::uint64_t>(&Store::block(view, leaf, 0, buffers[leaves++])));
    auto* out = reinterpret_cast<std::uint64_t*>(blocks + size);
    for (std::uint32_t i = 0; i < count; i += lanes_of<WidestWords>) {
      hn::StoreU(reference, words, references + size + i);
      hn::StoreU(block, pointers, out + i);
      hn::StoreU(block, pointers, out + i + lanes_of<WidestWords> / 2);
    }
    size += count;
  }

  /// Has one ray wait for each of some leaves.
  template <class Leaves>
  HWY_INLINE void add(const WideView& view, const Leaves& entered, std::uint32_t begin, std::uint32_t end) {
    std::copy(entered.rays + begin, entered.rays + end, rays + size);
    std::copy(entered.references + begin, entered.references + end, references + size);
    const std::uint32_t first = size, first_leaf = leaves;
    for (std::uint32_t i = 0; i < end - begin; ++i) {
      blocks[first + i] = &Store::block(view, entered.references[begin + i], 0, buffers[first_leaf + i]);
    }
    size += end - begin;
    leaves += end - begin;
  }
};

template <class Store>
struct StreamMemory {
  Slot slots[most_in_stream];
  alignas(64) std::uint32_t rays[stream_entries];  // offsets of slots
  // Of the node that is open: which children each of its rays meets, a bit each, and where these are.
  alignas(64) std::uint16_t met[room_for(most_in_stream)];
  alignas(64) WideReference children[Store::children];
  StreamNode nodes[stream_entries / room_for(few_rays + 1) + 1];  // the last first
  LeafQueue<Store> queue;
  RaysAtNodes<Store> single;
  typename RaysAtNodes<Store>::Leaves single_leaves;

  HWY_INLINE Slot& slot(std::uint32_t offset) {
    return *reinterpret_cast<Slot*>(reinterpret_cast<std::byte*>(slots) + offset);
  }
};

/// A blocked ray gets a limit before its beginning and so meets nothing more. Arithmetic, lest the compiler make a
/// branch of it that goes as the hits do.
HWY_INLINE void note(Slot& slot, bool found, std::uint8_t* blocked) {
  constexpr auto none = std::bit_cast<std::uint32_t>(-std::numeric_limits<float>::infinity());
  const std::uint32_t all = 0u - static_cast<std::uint32_t>(found);
  blocked[slot.index] |= static_cast<std::uint8_t>(found);
  slot.t_limit = std::bit_cast<float>((std::bit_cast<std::uint32_t>(slot.t_limit) & ~all) | (none & all));
}

template <class Store>
class AnyStream {
  static constexpr int N = Store::children;
  using D = Floats<N>;
  using V = hn::Vec<D>;
  using Words = hn::RebindToUnsigned<D>;
  static constexpr bool one_register = lanes_of<D> == N;

 public:
  /// Sets those of `blocked` that are, and leaves the others.
  AnyStream(const WideView& view, std::span<const Ray> rays, std::span<std::uint8_t> blocked,
            StreamMemory<Store>& memory)
      : view_(view), rays_(rays), blocked_(blocked.data()), memory_(memory) {}

  /// Traces the rays with these indices, all of one octant, a bit per axis: set where the direction is negative.
  void trace(std::span<const std::uint16_t> indices, std::uint32_t octant) {
    for (std::uint32_t axis = 0; axis < 3; ++axis) near_row_[axis] = 2 * axis + (octant >> axis & 1);
    const std::uint32_t size = load(indices);
    if (size != 0) walk(size);
  }

  /// Of all streams so far: how many rays entered a node together, on average, those that went on by themselves
  /// counted as one at each.
  double rays_per_node() const {
    return static_cast<double>(visits_ + single_visits_) / static_cast<double>(nodes_ + single_visits_);
  }

 private:
  /// Prepares the rays that can hit something; returns how many.
  HWY_INLINE std::uint32_t load(std::span<const std::uint16_t> indices) {
    std::uint32_t size = 0;
    for (std::size_t begin = 0; begin < indices.size(); begin += 8) {
      const std::size_t count = std::min<std::size_t>(8, indices.size() - begin);
      const auto index = [&](std::size_t i) { return indices[begin + std::min(i, count - 1)]; };
      const std::uint32_t first = size;
      const LoadedRays loaded = load_eight<Store::row_bytes>(
          view_.reach, [&](std::size_t i) HWY_ATTR -> const Ray& { return rays_[index(i)]; },
          [&](std::size_t i) HWY_ATTR -> Slot& { return memory_.slots[first + i]; });
      for (std::uint32_t i = 0; i < count; ++i) {
        if ((loaded.valid >> i & 1) == 0) continue;
        if (size != first + i) memory_.slots[size] = memory_.slots[first + i];
        memory_.slots[size++].index = index(i);
      }
    }
    return size;
  }

  HWY_INLINE void walk(std::uint32_t size) {
    for (std::uint32_t i = 0; i < size; ++i) memory_.rays[i] = i * static_cast<std::uint32_t>(sizeof(Slot));
    memory_.nodes[0] = {view_.root, 0, size};
    std::uint32_t left = 1;
    while (left != 0) {
      left = open(left - 1);
      // Leaves of a node first: what they block need not go into its other children.
      if (memory_.queue.size >= memory_.queue.enough) test_leaves();
    }
    while (!memory_.single.empty()) step_single();
    test_leaves();
  }

  /// Rays that go on by themselves take a step.
  HWY_NOINLINE void step_single() {
    const WideView view = view_;  // copies stay in registers
    auto& entered = memory_.single_leaves;
    single_visits_ += memory_.single.step(
        view, [this](std::uint32_t offset) HWY_ATTR -> const Slot& { return memory_.slot(offset); }, entered);
    LeafQueue<Store>& queue = memory_.queue;
    for (std::uint32_t done = 0; done < entered.size;) {
      const std::uint32_t end = std::min(entered.size, done + queue.most - queue.leaves);
      queue.add(view, entered, done, end);
      done = end;
      if (queue.size >= queue.enough) test_leaves();
    }
  }

  HWY_NOINLINE void test_leaves() {
    LeafQueue<Store>& queue = memory_.queue;
    std::uint32_t more = 0;
    if (queue.size != 0) more = test_first_blocks();
    if (HWY_UNLIKELY((more & more_blocks) != 0)) test_more_blocks();
    queue.size = queue.leaves = 0;
  }

  /// Returns the names of triangles, or'ed.
  HWY_INLINE std::uint32_t test_first_blocks() {
    LeafQueue<Store>& queue = memory_.queue;
    const std::uint32_t size = queue.size;
    std::uint32_t names = 0;
#if HWY_TARGET <= HWY_AVX3
    if constexpr (Store::triangles == 8) {
      queue.rays[size] = queue.rays[size - 1];  // an odd last ray is its own partner
      queue.blocks[size] = queue.blocks[size - 1];
      for (std::uint32_t i = 0; i < size; i += 2) {
        Slot &a = memory_.slot(queue.rays[i]), &b = memory_.slot(queue.rays[i + 1]);
        const auto &block_a = *queue.blocks[i], &block_b = *queue.blocks[i + 1];
        const std::uint32_t bits = bits_of(RayPair::D(), RayPair{a, b}.hit(block_a, block_b).hit);
        note(a, (bits & 0xff) != 0, blocked_);
        note(b, (bits & 0xff00) != 0, blocked_);
        names |= block_a.primitives[0] | block_b.primitives[0];
      }
      return names;
    }
#endif
    for (std::uint32_t i = 0; i < size; ++i) {
      Slot& slot = memory_.slot(queue.rays[i]);
      const auto& block = *queue.blocks[i];
      note(slot, any_in_block(block, slot.leaf, slot.t_near, slot.t_limit), blocked_);
      names |= block.primitives[0];
    }
    return names;
  }

  void test_more_blocks() {
    LeafQueue<Store>& queue = memory_.queue;
    for (std::uint32_t i = 0; i < queue.size; ++i) {
      if ((queue.blocks[i]->primitives[0] & more_blocks) == 0) continue;
      Slot& slot = memory_.slot(queue.rays[i]);
      slot.next = queue.references[i];
      note(slot, any_in_blocks<Store>(view_, 1, slot), blocked_);
    }
  }

  /// Writes those rays of the open node that meet the child in `lane` to `out`, and returns how many.
  HWY_INLINE std::uint32_t list_rays(const StreamNode& at, std::uint32_t lane, std::uint32_t* out) const {
    const WidestWords d;
    const hn::Rebind<std::uint16_t, WidestWords> halves;
    const auto bit = hn::Set(d, 1u << lane);
    const std::uint32_t* const rays = memory_.rays + at.begin;
    std::uint32_t count = 0;
    for (std::uint32_t i = 0; i < at.size; i += lanes_of<WidestWords>) {
      const auto met = hn::PromoteTo(d, hn::Load(halves, memory_.met + i));
      count += compress_store<WidestWords>(hn::Load(d, rays + i), hn::TestBit(met, bit), out + count);
    }
    return count;
  }

  /// Tests which children the rays of a node meet, the `top`-th of those left, and lists them. Returns how many nodes
  /// are left.
  HWY_INLINE std::uint32_t open(std::uint32_t top) {
    const Words dw;
    const StreamNode at = memory_.nodes[top];
    typename Store::NodeBuffer buffer;
    const WideNode<N>& node = Store::node(view_, at.reference, buffer);
    // Of one register of children all bits are written, of two parts of them the second adds to the first.
    std::fill_n(memory_.met + (one_register ? at.size : 0), one_register ? 16 : at.size + 16, std::uint16_t{0});
    std::uint32_t met = 0, leaves = 0;
    for (int first = 0; first < N; first += lanes_of<D>) {
      met |= meet(node, first, memory_.rays + at.begin, memory_.met, at.size);
      const auto children = hn::Load(dw, node.children + first);
      leaves |= bits_of(D(), hn::RebindMask(D(), hn::TestBit(children, hn::Set(dw, 1)))) << first;
      hn::Store(children, dw, memory_.children + first);
    }
    visits_ += at.size;
    ++nodes_;
    // Here, since those of the node before have had time to be fetched, and what was just stored to be read as vectors.
    while (memory_.single.enough()) step_single();
    list_leaves(at, met & leaves);
    return list_nodes(at, met & ~leaves, top);
  }

  /// Has rays of a node wait for the leaves that they enter.
  HWY_INLINE void list_leaves(const StreamNode& at, std::uint32_t lanes) {
    LeafQueue<Store>& queue = memory_.queue;
    for (; lanes != 0; lanes &= lanes - 1) {
      const auto lane = static_cast<std::uint32_t>(std::countr_zero(lanes));
      const WideReference leaf = memory_.children[lane];
      if (view_.out_of_cache) Store::prefetch(view_, leaf);
      queue.add(view_, leaf, list_rays(at, lane, queue.rays + queue.size));
      if (HWY_UNLIKELY(queue.size >= queue.most)) test_leaves();
    }
  }

  /// Lists the rays of all nodes below one at once, without a branch on how many there are. Returns how many nodes are
  /// left.
  HWY_INLINE std::uint32_t list_nodes(const StreamNode& at, std::uint32_t lanes, std::uint32_t top) {
    std::uint32_t end = at.begin + room_for(at.size);
    for (; lanes != 0; lanes &= lanes - 1) {
      const auto lane = static_cast<std::uint32_t>(std::countr_zero(lanes));
      const WideReference child = memory_.children[lane];
      if (view_.out_of_cache) Store::prefetch(view_, child);
      if (HWY_UNLIKELY(end + 2 * room_for(at.size) > stream_entries)) {
        one_by_one(at, lane);
        continue;
      }
      const std::uint32_t count = list_rays(at, lane, memory_.rays + end);
      const bool few = count <= few_rays;
      memory_.single.add(memory_.rays + end, child, few ? count : 0);
      memory_.nodes[top] = {child, end, count};
      top += few ? 0 : 1;
      end += few ? 0 : room_for(count);
    }
    return top;
  }

  /// Notes for each ray which of the children from `first` on it meets; returns which any of them does.
  HWY_INLINE std::uint32_t meet(const WideNode<N>& node, int first, const std::uint32_t* rays, std::uint16_t* met,
                                std::uint32_t size) const {
    const D d;
    const auto row = [&](std::uint32_t number) HWY_ATTR { return hn::Load(d, node.planes[number] + first); };
    const V near_x = row(near_row_[0]), near_y = row(near_row_[1]), near_z = row(near_row_[2]);
    const V far_x = row(near_row_[0] ^ 1), far_y = row(near_row_[1] ^ 1), far_z = row(near_row_[2] ^ 1);
    std::uint32_t any = 0;
    for (std::uint32_t i = 0; i < size; ++i) {
      const Slot& ray = memory_.slot(rays[i]);
      const V x = hn::Set(d, ray.inverse[0]), y = hn::Set(d, ray.inverse[1]), z = hn::Set(d, ray.inverse[2]);
      const auto plane = [&](V planes, V inverse, float offset)
                             HWY_ATTR { return hn::MulSub(planes, inverse, hn::Set(d, offset)); };
      const V entry = hn::Max(hn::Max(plane(near_x, x, ray.near_offset[0]), plane(near_y, y, ray.near_offset[1])),
                              hn::Max(plane(near_z, z, ray.near_offset[2]), hn::Set(d, ray.t_near)));
      const V exit = hn::Min(hn::Min(plane(far_x, x, ray.far_offset[0]), plane(far_y, y, ray.far_offset[1])),
                             hn::Min(plane(far_z, z, ray.far_offset[2]), hn::Set(d, ray.t_limit)));
      const std::uint32_t bits = bits_of(d, hn::Le(entry, exit)) << first;
      met[i] = static_cast<std::uint16_t>((one_register ? 0 : met[i]) | bits);
      any |= bits;
    }
    return any;
  }

  /// The rays of a node that meet one child.
  HWY_NOINLINE void one_by_one(const StreamNode& at, std::uint32_t lane) const {
    WideView below = view_;
    below.root = memory_.children[lane];
    for (std::uint32_t i = 0; i < at.size; ++i) {
      if ((memory_.met[i] >> lane & 1) == 0) continue;
      Slot& slot = memory_.slot(memory_.rays[at.begin + i]);
      note(slot, any_hit<Store>(below, prepare(rays_[slot.index], view_.reach), CountNothing{}), blocked_);
    }
  }

  const WideView& view_;
  std::span<const Ray> rays_;
  std::uint8_t* blocked_;
  StreamMemory<Store>& memory_;
  std::uint32_t near_row_[3] = {};
  std::uint64_t visits_ = 0, nodes_ = 0, single_visits_ = 0;
};

/// The rays of a block, octant by octant.
struct Octants {
  std::uint16_t indices[8][stream_block];
  std::uint32_t sizes[8] = {};

  HWY_INLINE explicit Octants(std::span<const Ray> rays) {
    const hn::FixedTag<std::int32_t, 4> d;
    for (std::size_t i = 0; i < rays.size(); ++i) {
      const auto direction = hn::BitCast(d, hn::LoadU(FourFloats(), &rays[i].direction.x));
      const std::uint32_t octant = bits_of_four(hn::RebindMask(FourFloats(), hn::Lt(direction, hn::Zero(d)))) & 7;
      indices[octant][sizes[octant]++] = static_cast<std::uint16_t>(i);
    }
  }
};

/// Streams are for rays that share nodes: when fewer than this enter one together, rays in flight are faster.
inline constexpr double least_together = 4;
/// How many show whether they do, and how many are traced in flight before the next look.
inline constexpr std::size_t stream_probe = 256, stream_pause = 8 * stream_block;
/// Fewer are not worth their lists, even those that lie between coherent groups, which are not looked at first.
inline constexpr std::size_t least_stream = 64;

/// Whether rays start near those before them, most of them: what scattered rays do not, at the price of a look at some.
HWY_INLINE bool start_close(std::span<const Ray> rays, float reach) {
  constexpr std::size_t step = 8;
  std::size_t looks = 0, close = 0;
  for (std::size_t i = step; i < rays.size(); i += step, ++looks) {
    const Vec3 way = rays[i].origin - rays[i - 1].origin;
    close += std::fabs(way.x) + std::fabs(way.y) + std::fabs(way.z) < reach / 16 ? 1 : 0;
  }
  return close * 4 >= looks * 3;
}

/// Traces rays from the first on for as long as it pays, and returns how many. `among_groups`: coherent groups are
/// before or behind them.
template <class Store>
HWY_NOINLINE std::size_t any_by_streams(const WideView& view, std::span<const Ray> rays,
                                        std::span<std::uint8_t> blocked, bool among_groups) {
  const std::size_t first = among_groups ? stream_block : stream_probe;
  const std::size_t least = among_groups ? least_stream : stream_probe;
  if (rays.size() < least) return 0;
  if (!among_groups && !start_close(rays.first(stream_probe), view.reach)) return 0;
  StreamMemory<Store> memory;
  std::size_t done = 0;
  while (done < rays.size()) {
    const std::size_t size = std::min(done == 0 ? first : stream_block, rays.size() - done);
    const auto part = rays.subspan(done, size);
    const auto answers = blocked.subspan(done, size);
    std::ranges::fill(answers, std::uint8_t{0});
    AnyStream<Store> stream(view, part, answers, memory);
    const Octants octants(part);
    for (std::uint32_t octant = 0; octant < 8; ++octant) {
      std::span<const std::uint16_t> left(octants.indices[octant], octants.sizes[octant]);
      while (!left.empty()) {
        const std::size_t taken = std::min<std::size_t>(most_in_stream, left.size());
        stream.trace(left.first(taken), octant);
        left = left.subspan(taken);
      }
    }
    done += size;
    if (!(stream.rays_per_node() >= least_together)) break;
  }
  return done;
}

#endif  // HWY_MAX_BYTES >= 32
}  // namespace HWY_NAMESPACE
}  // namespace boxwood
HWY_AFTER_NAMESPACE();
#endif
