// The builders of the PCA study and those it compares with, called by name.
#pragma once
#include "build/inputs.h"
#include "build/morton/stages.h"
#include "build/pca/stages.h"
#include "build/stages.h"

namespace boxwood {

inline const std::vector<Stage>& study_stages() {
  static const std::vector<Stage> all = {pca_stage(),    combined_stage(), distance_stage(), hlbvh_stage(),
                                         binned_stage(), middle_stage(),   equal_stage()};
  return all;
}

inline Tree build_study_tree(const std::string& text, const std::vector<Box>& boxes) {
  const LopsidedGeometry geometry(boxes);
  const StageCall call = stage_call(study_stages(), text);
  return call.stage->build(call.options, input_of(boxes, &geometry));
}

/// Every primitive below a node, ascending.
inline std::vector<std::uint32_t> primitives_below(const Tree& tree, std::uint32_t node) {
  std::vector<std::uint32_t> all, stack{node};
  while (!stack.empty()) {
    const Tree::Node& n = tree.nodes[stack.back()];
    stack.pop_back();
    for (std::uint32_t i = n.first; i < n.first + n.count; ++i) {
      if (n.is_leaf()) {
        all.push_back(tree.references[i]);
      } else {
        stack.push_back(i);
      }
    }
  }
  std::sort(all.begin(), all.end());
  return all;
}

inline std::vector<Box> subset(const std::vector<Box>& boxes, const std::vector<std::uint32_t>& primitives) {
  std::vector<Box> some;
  for (const std::uint32_t primitive : primitives) some.push_back(boxes[primitive]);
  return some;
}

/// References times area of the two children, over the area of the node: what a split costs but for the step.
inline double split_price(const Tree& tree, std::uint32_t node) {
  const Tree::Node& n = tree.nodes[node];
  double sum = 0;
  for (std::uint32_t child = n.first; child < n.first + 2; ++child) {
    sum += static_cast<double>(half_area(tree.nodes[child].bounds)) *
           static_cast<double>(primitives_below(tree, child).size());
  }
  return sum / static_cast<double>(half_area(n.bounds));
}

}  // namespace boxwood
