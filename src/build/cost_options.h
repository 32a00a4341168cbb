// Options of the builders that search for the cheapest cut.
#pragma once
#include "build/builder_options.h"
#include "build/prices.h"

namespace boxwood {

struct CostOptions {
  std::uint32_t k = 2;
  CostChoice cost = CostChoice::sah;
  AxisChoice axis = AxisChoice::all;
  Extent extent = Extent::centroids;
  CentroidKind centroid = CentroidKind::box;
  Stop stop = Stop::cost;
  std::uint32_t leaf = 4;
  float traversal_cost = 1;
  bool pairs = false;
  Coincident coincident = Coincident::halve;
};

/// What is searched, and when the search gives up.
template <class T>
void add_search(OptionsOf<T>& options) {
  options.choice("cost", static_cast<CostChoice T::*>(&T::cost), cost_model_names(),
                 "how likely a ray is taken to enter a child");
  options.choice("axis", static_cast<AxisChoice T::*>(&T::axis), {"longest", "all"}, "which axes are searched");
  options.choice("stop", static_cast<Stop T::*>(&T::stop), {"count", "cost"},
                 "when references that fit a leaf become one: always, or when splitting them does not pay");
  options.integer("leaf", static_cast<std::uint32_t T::*>(&T::leaf), 1, largest_leaf, "most references in a leaf");
  options.real("traversal_cost", static_cast<float T::*>(&T::traversal_cost), 0, 1e6f,
               "cost of visiting a node, in primitive tests; for stop=cost");
}

template <class T>
void add_cost_options(OptionsOf<T>& options) {
  add_arity(options);
  add_search(options);
  add_extent(options);
  add_centroid(options);
  options.flag("pairs", static_cast<bool T::*>(&T::pairs), "two references are always parted, whatever it costs");
  add_coincident(options);
}

/// The axes a set is to be cut along: [first, last]. Axes along which all centroids coincide are the caller's to skip.
struct AxisRange {
  int first, last;
};

inline AxisRange axes_of(const ReferenceSet& set, const CostOptions& options) {
  if (options.axis == AxisChoice::all) return {0, 2};
  const int axis = longest_axis(set, options.extent);
  return {axis, axis};
}

inline bool is_leaf_by_count(const ReferenceSet& set, const CostOptions& options) {
  return options.stop == Stop::count && set.size() <= options.leaf;
}

/// Whether a set whose cheapest parts cost `price` should rather be a leaf.
inline bool is_leaf_by_cost(const ReferenceSet& set, const CostOptions& options, float price) {
  if (options.stop != Stop::cost || set.size() > options.leaf || (options.pairs && set.size() == 2)) return false;
  return options.traversal_cost + price >= static_cast<float>(set.size());
}

/// Builds with `split(set, pricing)`, where pricing is that of the cost model chosen.
template <class Split>
Tree build_by_cost(BuildInput input, const CostOptions& options, const Split& split_set) {
  const Centroids centroids(input, options.centroid);
  if (options.cost == CostChoice::sah) {
    const auto split = [&](const ReferenceSet& set) { return split_set(set, centroids, SurfaceAreaPricing{}); };
    return build_top_down(std::move(input), centroids, options.leaf, split, options.coincident);
  }
  Box scene;
  for (const Reference& reference : input.references) scene.grow(reference.box());
  const std::unique_ptr<CostModel> model = make_cost_model(options.cost, scene);
  const auto split = [&](const ReferenceSet& set) { return split_set(set, centroids, ModelPricing(*model)); };
  return build_top_down(std::move(input), centroids, options.leaf, split, options.coincident);
}

}  // namespace boxwood
