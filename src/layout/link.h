#pragma once
#include <cstdint>

#include "tree/tree.h"

namespace boxwood {

/// What leads to a node, with all that must be known of it before its memory is touched. 8 bytes:
///   0  first        first reference of a leaf; of an inner node whatever its layout needs to find the children
///   4  count : 27   children, or references of a leaf; leaf : 1, axis : 2, fixed_order : 1 as in Tree::Node
struct Link {
  std::uint32_t first = 0;
  std::uint32_t count : 27 = 0;
  std::uint32_t leaf : 1 = 0;
  std::uint32_t axis : 2 = Tree::mixed_axis;
  std::uint32_t fixed_order : 1 = 0;
  std::uint32_t unused : 1 = 0;
};
static_assert(sizeof(Link) == 8);

inline Link link_to(const Tree::Node& node, std::uint32_t first) {
  Link link;
  link.first = first;
  link.count = node.count;
  link.leaf = node.leaf;
  link.axis = node.axis;
  link.fixed_order = node.fixed_order;
  return link;
}

}  // namespace boxwood
