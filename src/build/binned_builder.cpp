// Surface area heuristic over the borders of equal bins. Wald 2007, "On fast Construction of SAH-based Bounding Volume
// Hierarchies". Study variants:
//   wide BVH study `bsah`:   binned(k=K, axis=longest, extent=box, centroid=mean, stop=count, leaf=K, exact=0)
//   PCA study `sah` (pbrt):  binned(bins=12, axis=longest, pairs=on, exact=0, coincident=leaf)
//   SAH alternatives study:  binned(bins=10, leaf=1048576, traversal_cost=1.2, exact=0)
#include "build/binned_cuts.h"
#include "build/stages.h"
#include "build/sweep.h"

namespace boxwood {
namespace {

struct BinnedOptions : CostOptions {
  std::uint32_t bins = 16;
  std::uint32_t exact = 8;
};

template <class Pricing>
Cuts cut_at_bins(const ReferenceSet& set, const Centroids& centroids, const BinnedOptions& options, Pricing pricing) {
  if (set.size() <= options.exact) return sweep(set, centroids, options, pricing);
  if (is_leaf_by_count(set, options) || !pricing.begin(set)) return {};
  const BinnedCuts found =
      find_binned_cuts(set, centroids, set.centers, axes_of(set, options), options.bins, options, pricing);
  if (found.best.cuts.count == 0 || is_leaf_by_cost(set, options, found.leaf_price)) return {};
  return apply(found, set, centroids);
}

Tree build_binned(const BinnedOptions& options, BuildInput input) {
  return build_by_cost(std::move(input), options,
                       [&](const ReferenceSet& set, const Centroids& centroids, auto pricing) {
                         return cut_at_bins(set, centroids, options, pricing);
                       });
}

}  // namespace

Stage binned_stage() {
  OptionsOf<BinnedOptions> options;
  options.integer("bins", &BinnedOptions::bins, 2, max_bins, "bins per axis");
  add_cost_options(options);
  options.integer("exact", &BinnedOptions::exact, 0, 64,
                  "sets of at most this many references are swept, which is faster there and never worse");
  return with_cost<BinnedOptions>(
      builder_stage<BinnedOptions>("binned", "the cheapest border between equal bins",
                                   "Wald 2007; wide BVH study; PCA study; SAH alternatives study", options,
                                   build_binned, [](const BinnedOptions& chosen) { return chosen.k; }));
}

}  // namespace boxwood
