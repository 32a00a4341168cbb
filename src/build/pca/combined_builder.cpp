// At every node the cheaper of the best cut along the longest world axis and the best along the longest principal axis.
// Sauer 2019; PCA study, sections 2.7 and 2.8. Its methods:
//   Comb    combined(coincident=leaf, order=faithful)
//   Comb+M  combined(cost=overlap(disjoint=published), coincident=leaf, order=faithful)
// faithful: the number of the principal axis is kept even where the cut along the world's axis won.
#include <atomic>

#include "build/binned_cuts.h"
#include "build/pca/pca_options.h"
#include "build/pca/split_wins.h"
#include "build/pca/stages.h"
#include "build/plane_cuts.h"

namespace boxwood {
namespace {

using CombinedOptions = PcaCostOptions;

/// Counts of all threads.
struct Tally {
  std::atomic<std::uint64_t> classical = 0, principal = 0;
};

/// `tally`: null, or where to count which cut won.
template <class Pricing>
Cuts cut_at_the_cheaper(const ReferenceSet& set, const Centroids& centroids, const CombinedOptions& options,
                        Pricing pricing, Tally* tally) {
  if (is_leaf_by_count(set, options)) return {};
  const RotatedCentroids rotated(set, centroids);
  const Box4 range = rotated.range(set.references);
  const int longest = longest_axis(range);
  if (set.size() == 2 && options.pairs) return cut_by_count(set, rotated, longest, 2);
  if (!pricing.begin(set)) return {};

  const BinnedCuts classical =
      find_binned_cuts(set, centroids, set.centers, axes_of(set.centers, options.axis), options.bins, options, pricing);
  const BinnedCuts principal =
      find_binned_cuts(set, rotated, range, axes_of(range, options.axis), options.bins, options, pricing);
  const bool is_principal = principal.best.cuts.price < classical.best.cuts.price;
  const BinnedCuts& best = is_principal ? principal : classical;
  if (best.best.cuts.count == 0 || is_leaf_by_cost(set, options, best.leaf_price)) return {};
  if (tally) (is_principal ? tally->principal : tally->classical).fetch_add(1, std::memory_order_relaxed);
  Cuts cuts = is_principal ? apply(principal, set, rotated) : apply(classical, set, centroids);
  cuts.axis = static_cast<std::uint32_t>(longest);  // of the principal frame, whatever won: the study's program did so
  return cuts;
}

Tree build_and_tally(const CombinedOptions& options, BuildInput input, Tally* tally) {
  return build_on_principal_axes(std::move(input), options,
                                 [&](const ReferenceSet& set, const Centroids& centroids, auto pricing) {
                                   return cut_at_the_cheaper(set, centroids, options, pricing, tally);
                                 });
}

Tree build_combined(const CombinedOptions& options, BuildInput input) {
  return build_and_tally(options, std::move(input), nullptr);
}

}  // namespace

SplitWins count_split_wins(const PcaCostOptions& options, BuildInput input) {
  Tally tally;
  build_and_tally(options, std::move(input), &tally);
  return {tally.classical, tally.principal};
}

Stage combined_stage() {
  OptionsOf<CombinedOptions> options;
  add_pca_cost_options(options);
  return with_cost<CombinedOptions>(builder_stage<CombinedOptions>(
      "combined", "the cheaper of a cut along a world axis and one along a principal axis",
      "Sauer 2019 (Comb); PCA study", options, build_combined, [](const CombinedOptions&) { return 2u; }));
}

}  // namespace boxwood
