#include "tree/split_cost.h"

#include <cstdint>
#include <vector>

namespace boxwood {

double split_cost_sum(const Tree& tree) {
  // References below each node, from the last back: every node stands after its parent.
  std::vector<std::uint64_t> below(tree.nodes.size());
  double sum = 0;
  for (std::size_t i = tree.nodes.size(); i-- > 0;) {
    const Tree::Node& node = tree.nodes[i];
    if (node.is_leaf()) {
      below[i] = node.count;
      continue;
    }
    const double area = half_area(node.bounds);
    sum += 1;
    for (std::uint32_t child = node.first; child < node.first + node.count; ++child) {
      below[i] += below[child];
      const double probability = area > 0 ? static_cast<double>(half_area(tree.nodes[child].bounds)) / area : 1;
      sum += probability * static_cast<double>(below[child]);
    }
  }
  return sum;
}

}  // namespace boxwood
