// The kernel tables of slab and binary-split for one kind of node. Compiled once per instruction set.
#if defined(BOXWOOD_LAYOUT_SLAB_SPLIT_KERNELS_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef BOXWOOD_LAYOUT_SLAB_SPLIT_KERNELS_INL_H
#undef BOXWOOD_LAYOUT_SLAB_SPLIT_KERNELS_INL_H
#else
#define BOXWOOD_LAYOUT_SLAB_SPLIT_KERNELS_INL_H
#endif

#include "layout/slab/packet-inl.h"
#include "layout/slab/split_testers-inl.h"
#include "layout/walk-inl.h"

HWY_BEFORE_NAMESPACE();
namespace boxwood {
namespace HWY_NAMESPACE {

/// Batches cut into packets of N. Rays that are not alike, and the rest of a batch, go one by one.
template <class Nodes, int N, ChildOrder order, TraversalMode mode>
struct PacketBatches {
  using LevelType = Level<Nodes, TriangleLeaves>;
  using Single = KernelsOf<SplitTester<Nodes>, order, mode, Nodes, TriangleLeaves>;
  static constexpr PacketOrder packet_order{mode, order != ChildOrder::none};

  template <class CountingPolicy>
  static void closest(const LevelType& level, std::span<const Ray> rays, std::span<Hit> hits, RayCounters* counters) {
    each(
        rays.size(), counters,
        [&](std::size_t i, RayCounters* sum) {
          return closest_of_packet<Nodes, N, CountingPolicy>(level, packet_order, &rays[i], &hits[i], sum);
        },
        [&](std::size_t i, RayCounters* sum) {
          hits[i] = {};
          Single::template closest<CountingPolicy>(level, rays[i], {}, hits[i], sum);
        });
  }

  template <class CountingPolicy>
  static void any(const LevelType& level, std::span<const Ray> rays, std::span<std::uint8_t> blocked,
                  RayCounters* counters) {
    each(
        rays.size(), counters,
        [&](std::size_t i, RayCounters* sum) {
          return any_of_packet<Nodes, N, CountingPolicy>(level, packet_order, &rays[i], &blocked[i], sum);
        },
        [&](std::size_t i, RayCounters* sum) {
          blocked[i] = Single::template any<CountingPolicy>(level, rays[i], every_bit, sum) ? 1 : 0;
        });
  }

  static void closest_batch(const LevelType& level, std::span<const Ray> rays, std::span<Hit> hits) {
    closest<NoCounting>(level, rays, hits, nullptr);
  }
  static void any_batch(const LevelType& level, std::span<const Ray> rays, std::span<std::uint8_t> blocked) {
    any<NoCounting>(level, rays, blocked, nullptr);
  }
  static void closest_batch_counted(const LevelType& level, std::span<const Ray> rays, std::span<Hit> hits,
                                    std::span<RayCounters> counters) {
    closest<Counting>(level, rays, hits, counters.data());
  }
  static void any_batch_counted(const LevelType& level, std::span<const Ray> rays, std::span<std::uint8_t> blocked,
                                std::span<RayCounters> counters) {
    any<Counting>(level, rays, blocked, counters.data());
  }

 private:
  /// `counters`, unless null, gets for every ray of a packet what the packet cost.
  template <class Packet, class One>
  static HWY_INLINE void each(std::size_t size, RayCounters* counters, Packet packet, One one) {
    const auto counters_of = [&](std::size_t i) { return counters ? &(counters[i] = {}) : nullptr; };
    std::size_t i = 0;
    for (; i + N <= size; i += N) {
      if (packet(i, counters_of(i))) {
        if (counters) std::fill_n(counters + i + 1, N - 1, counters[i]);
      } else {
        for (std::size_t k = i; k < i + N; ++k) one(k, counters_of(k));
      }
    }
    for (; i < size; ++i) one(i, counters_of(i));
  }
};

template <class Nodes, int N, ChildOrder order>
void use_packets_in_order(TraversalMode mode, Kernels<Nodes, TriangleLeaves>& kernels) {
  const auto use = [&](auto batches) {
    kernels.closest_batch = batches.closest_batch;
    kernels.any_batch = batches.any_batch;
    kernels.closest_batch_counted = batches.closest_batch_counted;
    kernels.any_batch_counted = batches.any_batch_counted;
  };
  if (mode == TraversalMode::iterative) {
    use(PacketBatches<Nodes, N, order, TraversalMode::iterative>());
  } else {
    use(PacketBatches<Nodes, N, order, TraversalMode::recursive>());
  }
}

template <class Nodes, int N>
void use_packets(const TraceOptions& options, Kernels<Nodes, TriangleLeaves>& kernels) {
  switch (options.order) {
    case ChildOrder::none:
      return use_packets_in_order<Nodes, N, ChildOrder::none>(options.mode, kernels);
    case ChildOrder::axis:
      return use_packets_in_order<Nodes, N, ChildOrder::axis>(options.mode, kernels);
    case ChildOrder::near:
      return use_packets_in_order<Nodes, N, ChildOrder::near>(options.mode, kernels);
  }
}

template <class Nodes>
Kernels<Nodes, TriangleLeaves> split_kernels_over_triangles(const TraceOptions& options, std::uint32_t packet) {
  Kernels<Nodes, TriangleLeaves> kernels = choose_kernels<SplitTester<Nodes>, Nodes, TriangleLeaves>(options);
  if (!options.cull || !options.simd) return kernels;
  if (packet == 4) use_packets<Nodes, 4>(options, kernels);
  if (packet == 8) use_packets<Nodes, 8>(options, kernels);
  if (packet == 16) use_packets<Nodes, 16>(options, kernels);
  return kernels;
}

template <class Nodes>
Kernels<Nodes, InstanceLeaves> split_kernels_over_instances(const TraceOptions& options) {
  return choose_kernels<SplitTester<Nodes>, Nodes, InstanceLeaves>(options);
}

}  // namespace HWY_NAMESPACE
}  // namespace boxwood
HWY_AFTER_NAMESPACE();
#endif
