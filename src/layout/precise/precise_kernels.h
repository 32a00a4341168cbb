#pragma once
#include <cstdint>
#include <span>

#include "boxwood/counters.h"
#include "boxwood/precise.h"
#include "layout/precise/precise_level.h"

namespace boxwood {

/// One ray at a time; `counters` may be null.
struct PreciseKernels {
  PreciseHit (*closest)(const PreciseLevel&, const PreciseRay&, RayCounters* counters) = nullptr;
  bool (*any)(const PreciseLevel&, const PreciseRay&, RayCounters* counters) = nullptr;
};

/// For nodes of 4, 8 or 16 children; lives forever.
const PreciseKernels* precise_kernels(std::uint32_t k);

}  // namespace boxwood
