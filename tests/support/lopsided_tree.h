// A binary tree of which most is in a few subtrees that are chains.
#pragma once
#include <cstdint>
#include <vector>

#include "tree/assemble.h"

namespace boxwood::test {

/// References in order, one in a leaf. The first 512 are split in halves, so that tasks have enough subtrees early; the
/// others are in sixteen chains, of which each node has a leaf and all that follows as its children.
inline Tree lopsided_tree(std::uint32_t references) {
  struct Range {
    std::uint32_t begin, end;
  };
  const auto expand = [references](const Range& range, Tree::Node& node, std::vector<Range>& children,
                                   Tree::References& out) {
    const auto [begin, end] = range;
    node.bounds = Box{Vec3{static_cast<float>(begin), 0, 0}, Vec3{static_cast<float>(end), 1, 1}};
    if (end - begin == 1) {
      node.leaf = 1;
      node.count = 1;
      node.first = static_cast<std::uint32_t>(out.size());
      out.push_back(begin);
      return;
    }
    std::uint32_t middle = begin + 1;
    if (end - begin == references) {
      middle = 512;
    } else if (end <= 512 || (end - begin) * 16 > references) {
      middle = (begin + end) / 2;
    }
    children.push_back({begin, middle});
    children.push_back({middle, end});
  };
  return assemble(Range{0, references}, 2 * std::size_t{references} - 1, references, [&] { return expand; });
}

}  // namespace boxwood::test
