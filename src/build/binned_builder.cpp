// Surface area heuristic over the borders of equal bins. Wald 2007, "On fast Construction of SAH-based Bounding Volume
// Hierarchies". Study variants:
//   wide BVH study `bsah`:   binned(k=K, axis=longest, extent=box, centroid=mean, stop=count, leaf=K, exact=0)
//   PCA study `sah` (pbrt):  binned(bins=12, axis=longest, pairs=on, exact=0)
//   SAH alternatives study:  binned(bins=10, leaf=1048576, traversal_cost=1.2, exact=0)
#include "build/bins.h"
#include "build/stages.h"
#include "build/sweep.h"

namespace boxwood {
namespace {

struct BinnedOptions : CostOptions {
  std::uint32_t bins = 16;
  std::uint32_t exact = 8;
};

/// Moves the references that `is_left` holds for to the front and returns their number. Without a branch on the
/// outcome, which nothing could predict.
template <class IsLeft>
std::uint32_t partition(std::span<Reference> references, const IsLeft& is_left) {
  std::size_t left = 0;
  for (Reference& reference : references) {
    const Reference moved = reference;
    reference = references[left];
    references[left] = moved;
    left += is_left(moved) ? 1 : 0;
  }
  return static_cast<std::uint32_t>(left);
}

template <class Pricing>
Cuts cut_at_bins(const ReferenceSet& set, const Centroids& centroids, const BinnedOptions& options, Pricing pricing) {
  if (set.size() <= options.exact) return sweep(set, centroids, options, pricing);
  Cuts cuts;
  if (is_leaf_by_count(set, options) || !pricing.begin(set)) return cuts;

  // Bin along all axes in one pass.
  const BinMapping mapping(set.centers, options.bins);
  const AxisRange axes = axes_of(set, options);
  Bins bins(axes.first, axes.last, options.bins);
  fill(bins, set, centroids, mapping);
  if constexpr (Pricing::is_model) bins.count_seen(set.references, centroids, mapping);

  // Find the best axis.
  const auto search = [&](const auto& by) {
    BestAxis best;
    for (int axis = axes.first; axis <= axes.last; ++axis) {
      const BestCuts found = best_cuts(bins.row(axis), by, options.bins, options.k);
      if (found.price < best.cuts.price) best = {found, static_cast<std::uint32_t>(axis)};
    }
    return best;
  };
  const auto row = [&](const BestAxis& found) { return bins.row(static_cast<int>(found.axis)); };
  const auto parts = [&](const BestAxis& found) { return parts_of(row(found), found.cuts, options.bins); };
  const auto [best, best_axis] = search_with_rival(set, pricing, search, parts);
  cuts.axis = best_axis;
  if (best.count == 0) return cuts;
  const float price = price_for_leaf_test(set, options, bins.row(static_cast<int>(best_axis)), options.bins, best);
  if (is_leaf_by_cost(set, options, price)) return cuts;

  // Move the references into their parts.
  const auto axis = static_cast<int>(cuts.axis);
  std::uint32_t begin = 0;
  for (std::uint32_t i = 0; i < best.count; ++i) {
    const auto border = static_cast<std::int32_t>(best.at[i]);
    begin += partition(set.references.subspan(begin),
                       [&](const Reference& reference) { return mapping(centroids(reference), axis) < border; });
    cuts.add(begin, set.size());
  }
  return cuts;
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
