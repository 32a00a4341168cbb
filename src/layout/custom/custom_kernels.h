#pragma once
#include <cstdint>
#include <span>

#include "boxwood/counters.h"
#include "layout/custom/custom_layout.h"
#include "trace/hit_sink.h"

namespace boxwood {

/// As Kernels (kernel_layout.h), without what only levels of instances need.
struct CustomKernels {
  void (*closest)(const CustomLevel&, const Ray&, std::uint32_t instance, Hit& best, RayCounters*) = nullptr;
  bool (*any)(const CustomLevel&, const Ray&, RayCounters*) = nullptr;
  void (*offer)(const CustomLevel&, const Ray&, std::uint32_t instance, HitSink&) = nullptr;
  void (*closest_batch)(const CustomLevel&, std::span<const Ray>, std::span<Hit>) = nullptr;
  void (*any_batch)(const CustomLevel&, std::span<const Ray>, std::span<std::uint8_t>) = nullptr;
};

/// For nodes of 4, 8 or 16 children.
CustomKernels custom_kernels(std::uint32_t k);

}  // namespace boxwood
