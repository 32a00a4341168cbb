// The cheapest tree there is by surface area, not the greedy one: over small sets. Larger ones are swept greedily until
// they are small enough. SAH alternatives study, section 2.14.
#include <fmt/format.h>

#include <algorithm>

#include "boxwood/error.h"
#include "build/exhaustive/best_tree.h"
#include "build/exhaustive/stages.h"
#include "build/sweep.h"

namespace boxwood {
namespace {

struct ExhaustiveOptions {
  std::uint32_t most = 8;
  Partitions partitions = Partitions::sorted;
  Stop stop = Stop::cost;
  std::uint32_t leaf = 4;
  float traversal_cost = 1;
  CentroidKind centroid = CentroidKind::box;
};

/// The first cut of the best tree over a small set. Called again for the sides it finds their share of the same tree,
/// since the best subtree over a side does not depend on the rest.
Cuts cut_of_best_tree(const ReferenceSet& set, const Centroids& centroids, const ExhaustiveOptions& options) {
  std::vector<std::array<float, 3>> centers2;
  for (const Reference& reference : set.references) {
    const Float4 c = centroids(reference);
    centers2.push_back({c[0], c[1], c[2]});
  }
  const SmallSet small(set.references, centers2,
                       {double{options.traversal_cost}, options.leaf, options.stop == Stop::count});
  BestTree best(small, options.partitions);
  const Subset left = best.left(small.all());
  Cuts cuts;
  if (left == 0) return cuts;
  LargeVector<Reference> right;
  std::uint32_t place = 0;
  for (std::uint32_t i = 0; i < set.size(); ++i) {
    if (left >> i & 1) {
      set.references[place++] = set.references[i];
    } else {
      right.push_back(set.references[i]);
    }
  }
  std::ranges::copy(right, set.references.begin() + place);
  cuts.axis = Tree::mixed_axis;
  cuts.add(place, set.size());
  return cuts;
}

Tree build_exhaustive(const ExhaustiveOptions& options, BuildInput input) {
  constexpr std::uint32_t most_for_all = 20;
  if (options.partitions == Partitions::all && options.most > most_for_all) {
    throw UsageError(fmt::format("exhaustive(partitions=all) takes 3^most steps; use most={} or less", most_for_all));
  }
  const Centroids centroids(input, options.centroid);
  CostOptions greedy;
  greedy.stop = options.stop;
  greedy.leaf = options.leaf;
  greedy.traversal_cost = options.traversal_cost;
  return build_top_down(std::move(input), centroids, options.leaf, [&](const ReferenceSet& set) {
    if (set.size() <= options.most) return cut_of_best_tree(set, centroids, options);
    return sweep(set, centroids, greedy, SurfaceAreaPricing{});
  });
}

}  // namespace

Stage exhaustive_stage() {
  OptionsOf<ExhaustiveOptions> options;
  options
      .integer("most", &ExhaustiveOptions::most, 2, largest_small_set,
               "references whose best tree is sought; larger sets are swept greedily")
      .choice("partitions", &ExhaustiveOptions::partitions, {"sorted", "all"},
              "what is tried: cuts along an axis, or every partition there is, which takes 3^most steps")
      .choice("stop", &ExhaustiveOptions::stop, {"count", "cost"},
              "when references that fit a leaf become one: always, or when no tree over them is cheaper")
      .integer("leaf", &ExhaustiveOptions::leaf, 1, largest_leaf, "most references in a leaf")
      .real("traversal_cost", &ExhaustiveOptions::traversal_cost, 0, 1e6f,
            "cost of visiting a node, in primitive tests");
  add_centroid(options);
  return builder_stage<ExhaustiveOptions>("exhaustive", "the cheapest tree of all over small sets, greedy above",
                                          "SAH alternatives study", options, build_exhaustive,
                                          [](const ExhaustiveOptions&) { return 2u; });
}

}  // namespace boxwood
