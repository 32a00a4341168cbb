#pragma once
#include <cstdint>
#include <span>

#include "layout/wide/wide_nodes.h"

namespace boxwood {

/// Batches through a level of instances: rays walk to the instances they meet one after the other, and those that have
/// come to the same structure enter it together, as one batch in its space. Answers are those of single rays.
struct InstanceBatch {
  void (*closest)(const Level<WideNodes, InstanceLeaves>&, std::span<const Ray>, std::span<Hit>) = nullptr;
  void (*any)(const Level<WideNodes, InstanceLeaves>&, std::span<const Ray>, std::span<std::uint8_t>) = nullptr;
  /// With a mask for each ray.
  void (*closest_masked)(const Level<WideNodes, InstanceLeaves>&, std::span<const Ray>, std::span<const std::uint32_t>,
                         std::span<Hit>) = nullptr;
  void (*any_masked)(const Level<WideNodes, InstanceLeaves>&, std::span<const Ray>, std::span<const std::uint32_t>,
                     std::span<std::uint8_t>) = nullptr;
};

/// For nodes of 4, 8 or 16 children, walked from near to far; null for other widths.
InstanceBatch instance_batch(std::uint32_t k);

}  // namespace boxwood
