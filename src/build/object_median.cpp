#include "build/object_median.h"

#include "build/cut_by_count.h"

namespace boxwood {
namespace {

Tree build_object_median(const ObjectMedianOptions& options, BuildInput input) {
  const Centroids centroids(input, options.centroid);
  const std::uint32_t leaf = options.leaf ? options.leaf : options.k;
  const auto split = [&](const ReferenceSet& set) {
    if (set.size() <= leaf) return Cuts{};
    return cut_by_count(set, centroids, longest_axis(set, options.extent), options.k);
  };
  return build_top_down(std::move(input), centroids, leaf, split, options.coincident);
}

}  // namespace

Stage object_median_stage(std::string name, std::string summary, std::string source,
                          const ObjectMedianOptions& defaults) {
  OptionsOf<ObjectMedianOptions> options;
  add_arity(options);
  add_extent(options);
  add_centroid(options);
  options.integer("leaf", &ObjectMedianOptions::leaf, 0, largest_leaf, "references that make a leaf; 0: as many as k");
  add_coincident(options);
  Stage stage = builder_stage<ObjectMedianOptions>(std::move(name), std::move(summary), std::move(source), options,
                                                   build_object_median,
                                                   [](const ObjectMedianOptions& chosen) { return chosen.k; });
  stage.defaults = defaults;
  return stage;
}

}  // namespace boxwood
