#pragma once
#include <string>
#include <vector>

#include "boxwood/expected_use.h"
#include "boxwood/recipe.h"
#include "boxwood/scene.h"
#include "measure/compare.h"
#include "report/json.h"

namespace boxwood::cli {

/// What metrics say of the trees of a comparison, and how well that goes with the times measured.
struct ComparisonMetrics {
  std::string text;
  Json json;
};

/// Throws UsageError unless the scene is one mesh placed once: others have many trees.
void check_metrics(const Scene& scene);

/// Builds every tree once more. For scenes that check_metrics() passes. Runs in the caller's TBB arena.
ComparisonMetrics comparison_metrics(const Scene& scene, const std::vector<Recipe>& recipes, const ExpectedUse& use,
                                     const Comparison& comparison);

}  // namespace boxwood::cli
