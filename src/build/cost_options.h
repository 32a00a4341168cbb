// Options of the builders that search for the cheapest cut.
#pragma once
#include "build/best_cuts.h"
#include "build/builder_options.h"
#include "build/prices.h"
#include "cost/registry.h"
#include "recipe/stage.h"

namespace boxwood {

/// Whose prices say whether a split pays: those of the cost model, or of surface area whatever the model.
enum class LeafTest { model, area };

struct CostOptions {
  std::uint32_t k = 2;
  CostChoice cost;
  AxisChoice axis = AxisChoice::all;
  Extent extent = Extent::centroids;
  CentroidKind centroid = CentroidKind::box;
  Stop stop = Stop::cost;
  std::uint32_t leaf = 4;
  float traversal_cost = 1;
  LeafTest leaf_test = LeafTest::model;
  bool pairs = false;
  Coincident coincident = Coincident::halve;
};

/// What is searched, and when the search gives up.
template <class T>
void add_search(OptionsOf<T>& options) {
  add_cost_choice(options, "cost", static_cast<CostChoice T::*>(&T::cost),
                  "how likely a ray is taken to enter a child");
  options.choice("axis", static_cast<AxisChoice T::*>(&T::axis), {"longest", "all"}, "which axes are searched");
  options.choice("stop", static_cast<Stop T::*>(&T::stop), {"count", "cost"},
                 "when references that fit a leaf become one: always, or when splitting them does not pay");
  options.integer("leaf", static_cast<std::uint32_t T::*>(&T::leaf), 1, largest_leaf, "most references in a leaf");
  options.real("traversal_cost", static_cast<float T::*>(&T::traversal_cost), 0, 1e6f,
               "cost of visiting a node, in primitive tests; for stop=cost");
  options.choice("leaf_test", static_cast<LeafTest T::*>(&T::leaf_test), {"model", "area"},
                 "whose prices say whether splitting pays: the cost model's, or surface area whatever the model");
  options.flag("pairs", static_cast<bool T::*>(&T::pairs), "two references are always parted, whatever it costs");
  add_coincident(options);
}

template <class T>
void add_cost_options(OptionsOf<T>& options) {
  add_arity(options);
  add_search(options);
  add_extent(options);
  add_centroid(options);
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

/// The parts that `cuts` make of items [0, size).
template <class Items>
std::vector<Side> parts_of(const Items& items, const BestCuts& cuts, std::uint32_t size) {
  std::vector<Side> parts(cuts.count + 1);
  std::uint32_t part = 0;
  for (std::uint32_t i = 0; i < size; ++i) {
    if (part < cuts.count && i == cuts.at[part]) ++part;
    parts[part].box.grow(Box4(items.box(i)).box());
    parts[part].count += items.count(i);
    parts[part].seen += items.seen(i);
  }
  return parts;
}

/// What the leaf test is to hold against a leaf.
template <class Items>
float price_for_leaf_test(const ReferenceSet& set, const CostOptions& options, const Items& items, std::uint32_t size,
                          const BestCuts& cuts) {
  if (options.leaf_test == LeafTest::model || options.cost.is_surface_area()) return cuts.price;
  float price = 0;
  for (const Side& part : parts_of(items, cuts, size)) price += half_area(part.box) * static_cast<float>(part.count);
  return price / half_area(set.bounds);
}

/// Builds with `split(set, pricing)`, where pricing is that of the cost model chosen.
template <class Split>
Tree build_by_cost(BuildInput input, const CostOptions& options, const Split& split_set) {
  const Centroids centroids(input, options.centroid);
  const auto split_by_area = [&](const ReferenceSet& set) { return split_set(set, centroids, SurfaceAreaPricing{}); };
  if (options.cost.is_surface_area()) {
    return build_top_down(std::move(input), centroids, options.leaf, split_by_area, options.coincident);
  }
  Box scene;
  for (const Reference& reference : input.references) scene.grow(reference.box());
  const std::unique_ptr<CostModel> model = options.cost.make({scene, input.use});
  mark_seen(input);
  const auto split = [&](const ReferenceSet& set) {
    if (model->is_surface_area(set.memory)) return split_by_area(set);
    return split_set(set, centroids, ModelPricing(*model));
  };
  return build_top_down(std::move(input), centroids, options.leaf, split, options.coincident, model.get());
}

/// Tells the registry whether a stage with these options must know what will be traced.
template <class Options>
Stage with_cost(Stage stage) {
  stage.needs_use = [](const std::any& chosen) { return std::any_cast<const Options&>(chosen).cost.needs_use(); };
  return stage;
}

}  // namespace boxwood
