// Spatial median: planes at equal distances. middle() is pbrt's and the PCA study's `middle` (midpoint of the
// centroids' box, strictly below goes left); middle(plane=box) is the single slab study's spatial median cut (midpoint
// of the node's box, up to and including it goes left). Where every centroid falls between the same two planes, by
// count.
#include <algorithm>

#include "build/builder_options.h"
#include "build/cut_by_count.h"
#include "build/stages.h"

namespace boxwood {
namespace {

struct MiddleOptions {
  std::uint32_t k = 2;
  Extent plane = Extent::centroids;
  CentroidKind centroid = CentroidKind::box;
  std::uint32_t leaf = 1;
};

Cuts cut_in_the_middle(const ReferenceSet& set, const Centroids& centroids, const MiddleOptions& options) {
  const int axis = longest_axis(set, options.plane);
  const bool box = options.plane == Extent::box;
  // Doubled, as centroids are.
  const float low = box ? set.bounds.lower[axis] * 2 : set.centers.lower[axis];
  const float high = box ? set.bounds.upper[axis] * 2 : set.centers.upper[axis];
  Cuts cuts;
  cuts.axis = static_cast<std::uint32_t>(axis);
  auto begin = set.references.begin();
  for (std::uint32_t i = 1; i < options.k; ++i) {
    const float share = static_cast<float>(i) / static_cast<float>(options.k);
    const float plane = low * (1 - share) + high * share;
    begin = std::partition(begin, set.references.end(), [&](const Reference& reference) {
      const float center = centroids(reference)[axis];
      return box ? center <= plane : center < plane;
    });
    cuts.add(static_cast<std::uint32_t>(begin - set.references.begin()), set.size());
  }
  return cuts.count ? cuts : cut_by_count(set, centroids, axis, options.k);
}

Tree build_middle(const MiddleOptions& options, BuildInput input) {
  const Centroids centroids(input, options.centroid);
  return build_top_down(std::move(input), centroids, options.leaf, [&](const ReferenceSet& set) {
    return set.size() <= options.leaf ? Cuts{} : cut_in_the_middle(set, centroids, options);
  });
}

}  // namespace

Stage middle_stage() {
  OptionsOf<MiddleOptions> options;
  add_arity(options);
  options.choice("plane", &MiddleOptions::plane, {"centroids", "box"},
                 "what is cut at equal distances along its longest side: the centroids' box or the node's");
  add_centroid(options);
  options.integer("leaf", &MiddleOptions::leaf, 1, largest_leaf, "references that make a leaf");
  return builder_stage<MiddleOptions>("middle", "planes at equal distances along the longest side",
                                      "Pharr, Jakob, Humphreys 2016 (Middle); PCA study; single slab study", options,
                                      build_middle, [](const MiddleOptions& chosen) { return chosen.k; });
}

}  // namespace boxwood
