// Before every split the centroids are turned into the frame of their principal axes and cut along its longest side;
// boxes stay those of the world. Sauer 2019, "Entwicklung und Evaluation einer auf der Hauptkomponentenanalyse
// basierenden Bounding Volume Hierarchy". The study's methods:
//   PCA-SAH     pca(coincident=leaf, order=faithful)
//   PCA-Middle  pca(split=middle, coincident=leaf, order=faithful)
// faithful: the program kept the number of the principal axis, which its traversal took for a world axis.
#include "build/binned_cuts.h"
#include "build/pca/pca_options.h"
#include "build/pca/stages.h"
#include "build/plane_cuts.h"

namespace boxwood {
namespace {

enum class SplitRule { middle, sah };

struct PcaOptions : PcaCostOptions {
  SplitRule split = SplitRule::sah;
};

template <class Pricing>
Cuts cut_along_principal_axes(const ReferenceSet& set, const Centroids& centroids, const PcaOptions& options,
                              Pricing pricing) {
  if (is_leaf_by_count(set, options)) return {};
  const RotatedCentroids points(set, centroids);
  const Box4 range = points.range(set.references);
  const int longest = longest_axis(range);
  if (options.split == SplitRule::middle) {
    return cut_at_planes(set, points, {longest, range.lower[longest], range.upper[longest]}, 2);
  }
  if (set.size() == 2 && options.pairs) return cut_by_count(set, points, longest, 2);
  if (!pricing.begin(set)) return {};
  const BinnedCuts found =
      find_binned_cuts(set, points, range, axes_of(range, options.axis), options.bins, options, pricing);
  if (found.best.cuts.count == 0 || is_leaf_by_cost(set, options, found.leaf_price)) return {};
  return apply(found, set, points);
}

Tree build_pca(const PcaOptions& chosen, BuildInput input) {
  PcaOptions options = chosen;
  if (options.split == SplitRule::middle) options.leaf = 1;
  return build_on_principal_axes(std::move(input), options,
                                 [&](const ReferenceSet& set, const Centroids& centroids, auto pricing) {
                                   return cut_along_principal_axes(set, centroids, options, pricing);
                                 });
}

}  // namespace

Stage pca_stage() {
  OptionsOf<PcaOptions> options;
  options.choice(
      "split", &PcaOptions::split, {"middle", "sah"},
      "where the longest principal axis is cut: midway, one reference per leaf, or at the cheapest bin border");
  add_pca_cost_options(options);
  return with_cost<PcaOptions>(builder_stage<PcaOptions>("pca", "cuts along the principal axes of the centroids",
                                                         "Sauer 2019; PCA study", options, build_pca,
                                                         [](const PcaOptions&) { return 2u; }));
}

}  // namespace boxwood
