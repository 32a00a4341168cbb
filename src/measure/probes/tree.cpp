// The shape of the trees, before layout.
#include <algorithm>

#include "measure/probes/probes.h"
#include "tree/statistics.h"

namespace boxwood {
namespace {

struct Shape {
  double inner_nodes = 0, leaves = 0, references = 0, depth = 0, arity = 0, leaf_size = 0;
  double upper_overlap = 0, lower_overlap = 0;
};

/// Mean of values[begin … end), 0 for none.
double mean_of(const std::vector<double>& values, std::size_t begin, std::size_t end) {
  double sum = 0;
  for (std::size_t i = begin; i < end; ++i) sum += values[i];
  return end > begin ? sum / static_cast<double>(end - begin) : 0;
}

std::uint32_t largest_leaf(const Tree& tree) {
  std::uint32_t largest = 0;
  for (const Tree::Node& node : tree.nodes) {
    if (node.is_leaf()) largest = std::max<std::uint32_t>(largest, node.count);
  }
  return largest;
}

/// Counts are summed over meshes, extremes are the largest, overlap is that of the largest tree.
Shape shape_of(const std::vector<Tree>& trees) {
  Shape shape;
  std::size_t most_nodes = 0;
  for (const Tree& tree : trees) {
    const TreeStatistics one = statistics(tree);
    shape.inner_nodes += static_cast<double>(one.inner_nodes);
    shape.leaves += static_cast<double>(one.leaves);
    shape.references += static_cast<double>(one.references);
    shape.depth = std::max<double>(shape.depth, one.max_depth);
    shape.arity = std::max<double>(shape.arity, one.max_arity);
    shape.leaf_size = std::max<double>(shape.leaf_size, largest_leaf(tree));
    if (tree.nodes.size() <= most_nodes) continue;
    most_nodes = tree.nodes.size();
    const std::size_t half = one.sibling_overlap.size() / 2;
    shape.upper_overlap = mean_of(one.sibling_overlap, 0, half);
    shape.lower_overlap = mean_of(one.sibling_overlap, half, one.sibling_overlap.size());
  }
  return shape;
}

std::vector<Value> measure_tree(const ProbeInput& input) {
  if (input.trees().empty()) return {};
  const Shape shape = shape_of(input.trees());
  return {{"inner_nodes", shape.inner_nodes},
          {"leaves", shape.leaves},
          {"references", shape.references},
          {"depth", shape.depth},
          {"arity", shape.arity},
          {"leaf_size", shape.leaf_size},
          {"upper_overlap", shape.upper_overlap},
          {"lower_overlap", shape.lower_overlap}};
}

}  // namespace

Probe tree_probe() {
  return {"tree",
          ProbeScope::structure,
          false,
          "the shape of the tree",
          {{"inner_nodes", "nodes", "inner nodes"},
           {"leaves", "leaves", "leaves"},
           {"references", "references", "primitives in all leaves together"},
           {"depth", "levels", "edges from the root to the deepest leaf"},
           {"arity", "children", "most children that a node has"},
           {"leaf_size", "references", "most references that a leaf has"},
           {"upper_overlap", "", "area of overlap between siblings over their parent's area, mean of the upper levels"},
           {"lower_overlap", "", "the same of the lower levels"}},
          measure_tree};
}

}  // namespace boxwood
