#include "build/child_order.h"

#include <utility>

#include "tree/child_axis.h"

namespace boxwood {

void correct_child_order(Tree& tree) {
  for (Tree::Node& node : tree.nodes) {
    if (node.is_leaf()) continue;
    Tree::Node &first = tree.nodes[node.first], &second = tree.nodes[node.first + 1];
    const ChildAxis axis = child_axis(first.bounds, second.bounds);
    node.axis = axis.axis & 3;
    if (axis.descending) std::swap(first, second);
  }
}

}  // namespace boxwood
