#pragma once
#include <cstdint>
#include <span>

#include "boxwood/counters.h"
#include "boxwood/precise.h"
#include "layout/precise/precise_level.h"

namespace boxwood {

/// `counters` may be null. Batches are as long as their answers.
struct PreciseKernels {
  PreciseHit (*closest)(const PreciseLevel&, const PreciseRay&, RayCounters* counters) = nullptr;
  bool (*any)(const PreciseLevel&, const PreciseRay&, RayCounters* counters) = nullptr;
  void (*closest_batch)(const PreciseLevel&, std::span<const PreciseRay>, std::span<PreciseHit>) = nullptr;
  void (*any_batch)(const PreciseLevel&, std::span<const PreciseRay>, std::span<std::uint8_t>) = nullptr;
};

/// For nodes of 4, 8 or 16 children; lives forever.
const PreciseKernels* precise_kernels(std::uint32_t k);

}  // namespace boxwood
