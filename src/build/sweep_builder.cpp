// Surface area heuristic over every gap between sorted centroids. The wide BVH study's `sah` is
// sweep(k=K, axis=longest, extent=box, centroid=mean, stop=count, leaf=K); the SAH alternatives study's greedy tree is
// sweep(leaf=1048576, traversal_cost=1.2).
#include "build/stages.h"
#include "build/sweep.h"

namespace boxwood {
namespace {

struct SweepOptions : CostOptions {};

Tree build_sweep(const SweepOptions& options, BuildInput input) {
  return build_by_cost(std::move(input), options,
                       [&](const ReferenceSet& set, const Centroids& centroids, auto pricing) {
                         return sweep(set, centroids, options, pricing);
                       });
}

}  // namespace

Stage sweep_stage() {
  OptionsOf<SweepOptions> options;
  add_cost_options(options);
  return with_cost<SweepOptions>(
      builder_stage<SweepOptions>("sweep", "the cheapest of all gaps between sorted centroids",
                                  "MacDonald and Booth 1990; wide BVH study; SAH alternatives study", options,
                                  build_sweep, [](const SweepOptions& chosen) { return chosen.k; }));
}

}  // namespace boxwood
