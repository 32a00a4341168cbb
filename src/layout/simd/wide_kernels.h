#pragma once
#include <cstdint>
#include <span>

#include "boxwood/counters.h"
#include "boxwood/ray.h"
#include "layout/simd/wide_arena.h"
#include "trace/hit_sink.h"

namespace boxwood {

/// The queries of one kind of arena, compiled for one instruction set.
struct WideKernels {
  Hit (*closest_hit)(const WideView&, const Ray&);
  bool (*any_hit)(const WideView&, const Ray&);
  void (*closest_hits)(const WideView&, std::span<const Ray>, std::span<Hit>);
  void (*any_hits)(const WideView&, std::span<const Ray>, std::span<std::uint8_t>);
  Hit (*closest_hit_counted)(const WideView&, const Ray&, RayCounters&);
  bool (*any_hit_counted)(const WideView&, const Ray&, RayCounters&);
  void (*offer_hits)(const WideView&, const Ray&, std::uint32_t instance, HitSink&);
};

/// The best kernels this machine can run, for nodes of N children and leaf blocks of L triangles.
template <int N, int L>
WideKernels wide_kernels();

}  // namespace boxwood
