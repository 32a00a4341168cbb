#pragma once
#include <cstddef>
#include <cstdint>
#include <vector>

#include "tree/tree.h"

namespace boxwood {

/// A part of an octree under construction: the root first, children side by side after their parents.
struct OctreeSubtree {
  Tree::Nodes nodes;
  std::vector<OctreeCode> codes;  ///< [i] = cell of nodes[i]
  Tree::References references;

  /// Room for `count` siblings; returns the first's place.
  std::size_t add_siblings(std::size_t count) {
    nodes.resize(nodes.size() + count);
    codes.resize(nodes.size());
    return nodes.size() - count;
  }

  /// Drops what was added after it had this many nodes and references.
  void cut_back(std::size_t node_count, std::size_t reference_count) {
    nodes.resize(node_count);
    codes.resize(node_count);
    references.resize(reference_count);
  }

  /// Puts the root of `other` at `place`, and what is below it at the end.
  void append(const OctreeSubtree& other, std::size_t place) {
    const auto shift = static_cast<std::uint32_t>(nodes.size()) - 1;
    const auto first_reference = static_cast<std::uint32_t>(references.size());
    const auto settled = [&](Tree::Node node) {
      node.first += node.is_leaf() ? first_reference : shift;
      return node;
    };
    references.insert(references.end(), other.references.begin(), other.references.end());
    nodes[place] = settled(other.nodes[0]);
    codes[place] = other.codes[0];
    for (std::size_t i = 1; i < other.nodes.size(); ++i) nodes.push_back(settled(other.nodes[i]));
    codes.insert(codes.end(), other.codes.begin() + 1, other.codes.end());
  }
};

}  // namespace boxwood
