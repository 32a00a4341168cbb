// Spatial median: planes at equal distances. middle(coincident=leaf) is pbrt's and the PCA study's `middle` (midpoint
// of the centroids' box, strictly below goes left); middle(plane=box) is the single slab study's spatial median cut
// (midpoint of the node's box, up to and including it goes left). Where every centroid falls between the same two
// planes, by count.
#include "build/builder_options.h"
#include "build/plane_cuts.h"
#include "build/stages.h"

namespace boxwood {
namespace {

struct MiddleOptions {
  std::uint32_t k = 2;
  Extent plane = Extent::centroids;
  CentroidKind centroid = CentroidKind::box;
  std::uint32_t leaf = 1;
  Coincident coincident = Coincident::halve;
};

Cuts cut_in_the_middle(const ReferenceSet& set, const Centroids& centroids, const MiddleOptions& options) {
  const int axis = longest_axis(set, options.plane);
  // Doubled, as centroids are.
  const PlaneRange range = options.plane == Extent::box
                               ? PlaneRange{axis, set.bounds.lower[axis] * 2, set.bounds.upper[axis] * 2, true}
                               : PlaneRange{axis, set.centers.lower[axis], set.centers.upper[axis], false};
  return cut_at_planes(set, centroids, range, options.k);
}

Tree build_middle(const MiddleOptions& options, BuildInput input) {
  const Centroids centroids(input, options.centroid);
  const auto split = [&](const ReferenceSet& set) {
    return set.size() <= options.leaf ? Cuts{} : cut_in_the_middle(set, centroids, options);
  };
  return build_top_down(std::move(input), centroids, options.leaf, split, options.coincident);
}

}  // namespace

Stage middle_stage() {
  OptionsOf<MiddleOptions> options;
  add_arity(options);
  options.choice("plane", &MiddleOptions::plane, {"centroids", "box"},
                 "what is cut at equal distances along its longest side: the centroids' box or the node's");
  add_centroid(options);
  options.integer("leaf", &MiddleOptions::leaf, 1, largest_leaf, "references that make a leaf");
  add_coincident(options);
  return builder_stage<MiddleOptions>("middle", "planes at equal distances along the longest side",
                                      "Pharr, Jakob, Humphreys 2016 (Middle); PCA study; single slab study", options,
                                      build_middle, [](const MiddleOptions& chosen) { return chosen.k; });
}

}  // namespace boxwood
