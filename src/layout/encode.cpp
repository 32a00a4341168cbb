#include "layout/encode.h"

#include <fmt/format.h>

#include <algorithm>

#include "boxwood/error.h"

namespace boxwood {

void check_walkable(const Tree& tree, std::uint32_t arity, std::string_view layout) {
  std::vector<std::uint32_t> needed(tree.nodes.size(), 1);
  std::uint32_t most = 0;
  for (std::size_t i = 0; i < tree.nodes.size(); ++i) {
    const Tree::Node& node = tree.nodes[i];
    if (node.is_leaf()) continue;
    if (node.count > arity) {
      throw UsageError(fmt::format("'{}' holds nodes of at most {} children, but node {} of the tree has {}", layout,
                                   arity, i, node.count));
    }
    for (std::uint32_t c = 0; c < node.count; ++c) {
      needed[node.first + c] = needed[i] + node.count - 1;
      most = std::max(most, needed[node.first + c]);
    }
  }
  if (most > stack_entries) {
    throw Error(
        fmt::format("the tree is too deep to walk: a path has {} siblings to remember and '{}' has room for {}; "
                    "build with 'median', whose depth is bounded, or with larger leaves",
                    most, layout, stack_entries));
  }
}

std::vector<std::uint32_t> depth_first_places(const Tree& tree, bool inner_only) {
  // First the sizes of all subtrees, from the last node back: every node stands after its parent.
  std::vector<std::uint32_t> places(tree.nodes.size());
  for (std::size_t i = tree.nodes.size(); i-- > 0;) {
    const Tree::Node& node = tree.nodes[i];
    places[i] = node.is_leaf() && inner_only ? 0 : 1;
    for (std::uint32_t c = 0; c < node.count && !node.is_leaf(); ++c) places[i] += places[node.first + c];
  }
  // Then every parent turns its children's sizes into places.
  if (!places.empty()) places[0] = 0;
  for (std::size_t i = 0; i < tree.nodes.size(); ++i) {
    const Tree::Node& node = tree.nodes[i];
    if (node.is_leaf()) continue;
    std::uint32_t next = places[i] + 1;
    for (std::uint32_t c = 0; c < node.count; ++c) {
      const std::uint32_t size = places[node.first + c];
      places[node.first + c] = next;
      next += size;
    }
  }
  return places;
}

}  // namespace boxwood
