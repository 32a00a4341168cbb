#pragma once
#include "cost/cost_model.h"

namespace boxwood {

/// The surface area heuristic: p = area(child) / area(parent), the share of the lines through a convex body that also
/// meet a convex part of it. Goldsmith and Salmon 1987; MacDonald and Booth 1990. Builders inline it (build/prices.h).
class SurfaceArea final : public CostModel {
 public:
  void probabilities(const Node& parent, std::span<const Side> sides, std::span<float> out) const override;
  bool is_surface_area(const Memory*) const override { return true; }
};

}  // namespace boxwood
