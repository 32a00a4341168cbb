#pragma once
// A tree without a builder: equal counts along the longest axis of the centres, k ways.
#include <algorithm>
#include <cstdint>
#include <numeric>
#include <span>
#include <vector>

#include "boxwood/scene.h"
#include "tree/tree.h"

namespace boxwood::test {

/// Boxes of all triangles of a mesh; empty for those that cannot be used.
inline std::vector<Box> triangle_boxes(const Mesh& mesh) {
  std::vector<Box> boxes(mesh.triangles.size());
  for (std::uint32_t i = 0; i < boxes.size(); ++i) {
    if (!is_usable(mesh, i)) continue;
    for (const std::uint32_t vertex : mesh.triangles[i]) boxes[i].grow(mesh.positions[vertex]);
  }
  return boxes;
}

/// A chain: every inner node has one leaf, of the triangle with its number, and the rest. One level per triangle but
/// one, of at least two.
inline Tree chain(const Mesh& mesh) {
  const std::vector<Box> boxes = triangle_boxes(mesh);
  const auto count = static_cast<std::uint32_t>(boxes.size());
  Tree tree;
  tree.references.resize(count);
  std::iota(tree.references.begin(), tree.references.end(), 0u);
  std::vector<Box> rests = boxes;
  for (std::uint32_t i = count - 1; i-- > 0;) rests[i].grow(rests[i + 1]);
  const auto add = [&](const Box& bounds, std::uint32_t first, std::uint32_t size, bool leaf) {
    Tree::Node node;
    node.bounds = bounds;
    node.first = first;
    node.count = size & Tree::max_count;
    node.leaf = leaf ? 1 : 0;
    tree.nodes.push_back(node);
  };
  add(rests[0], 1, 2, false);
  for (std::uint32_t i = 0; i + 1 < count; ++i) {
    const bool last = i + 2 == count;
    add(boxes[i], i, 1, true);
    add(rests[i + 1], last ? i + 1 : 2 * i + 3, last ? 1 : 2, last);
  }
  return tree;
}

struct SplitTreeOptions {
  std::uint32_t k = 2;
  std::uint32_t leaf_size = 2;
  bool mark_nodes = false;  ///< declare some nodes of mixed axis and some of fixed order, which is always allowed
};

/// Over the boxes that are not empty.
inline Tree split_tree(std::span<const Box> boxes, const SplitTreeOptions& options) {
  Tree tree;
  for (std::uint32_t i = 0; i < boxes.size(); ++i) {
    if (!boxes[i].empty()) tree.references.push_back(i);
  }
  if (tree.references.empty()) return tree;
  const auto node_over = [&](std::uint32_t first, std::uint32_t count) {
    Tree::Node node;
    for (std::uint32_t i = first; i < first + count; ++i) node.bounds.grow(boxes[tree.references[i]]);
    node.first = first;
    node.count = count & Tree::max_count;
    node.leaf = 1;
    return node;
  };
  tree.nodes.push_back(node_over(0, static_cast<std::uint32_t>(tree.references.size())));
  for (std::size_t n = 0; n < tree.nodes.size(); ++n) {
    const Tree::Node leaf = tree.nodes[n];
    if (leaf.count <= std::max(1u, options.leaf_size)) continue;
    const auto begin = tree.references.begin() + leaf.first;
    const int axis = longest_axis(leaf.bounds.extent());
    std::sort(begin, begin + leaf.count, [&](std::uint32_t a, std::uint32_t b) {
      const float ca = boxes[a].center()[axis], cb = boxes[b].center()[axis];
      return ca != cb ? ca < cb : a < b;
    });
    const std::uint32_t children = std::min(options.k, leaf.count);
    Tree::Node inner = leaf;
    inner.first = static_cast<std::uint32_t>(tree.nodes.size());
    inner.count = children & Tree::max_count;
    inner.leaf = 0;
    inner.axis = options.mark_nodes && n % 3 == 1 ? Tree::mixed_axis : static_cast<std::uint32_t>(axis) & 3;
    inner.fixed_order = options.mark_nodes && n % 5 == 2 ? 1 : 0;
    tree.nodes[n] = inner;
    for (std::uint32_t c = 0; c < children; ++c) {
      const std::uint32_t from = leaf.count * c / children, to = leaf.count * (c + 1) / children;
      tree.nodes.push_back(node_over(leaf.first + from, to - from));
    }
  }
  return tree;
}

}  // namespace boxwood::test
