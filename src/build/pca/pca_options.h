// What the builders on principal axes have in common.
#pragma once
#include "build/bins.h"
#include "build/child_order.h"
#include "build/cost_options.h"
#include "build/pca/rotated_centroids.h"
#include "build/spatial/presplit.h"

namespace boxwood {

/// Defaults are those of the PCA study, but for the order of children.
struct PcaCostOptions : CostOptions {
  PcaCostOptions() {
    axis = AxisChoice::longest;
    pairs = true;
  }
  std::uint32_t bins = 12;
  StoredOrder order = StoredOrder::corrected;
  float presplit = 0;
};

template <class T>
void add_pca_cost_options(OptionsOf<T>& options) {
  options.integer("bins", static_cast<std::uint32_t T::*>(&T::bins), 2, max_bins, "bins per axis");
  add_search(options);
  add_centroid(options);
  add_stored_order(options);
  options.real("presplit", static_cast<float T::*>(&T::presplit), 0, 4,
               "references that cutting long triangles first may add, as a part of all");
}

inline AxisRange axes_of(const Box4& range, AxisChoice choice) {
  if (choice == AxisChoice::all) return {0, 2};
  const int axis = longest_axis(range);
  return {axis, axis};
}

/// As build_by_cost(), with long triangles cut first and children put in order after, where the options say so.
template <class Split>
Tree build_on_principal_axes(BuildInput input, const PcaCostOptions& options, const Split& split_set) {
  // Boxes alone, of instances, cannot be cut.
  const bool cut = options.presplit > 0 && input.geometry;
  if (cut) input.references = presplit(std::move(input.references), *input.geometry, options.presplit);
  Tree tree = build_by_cost(std::move(input), options, split_set);
  tree.clipped_leaves = cut;
  if (options.order == StoredOrder::corrected) correct_child_order(tree);
  return tree;
}

}  // namespace boxwood
