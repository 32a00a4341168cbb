#include "layout/slab/split_encode.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "boxwood/error.h"
#include "layout/encode.h"
#include "layout/slab/slab_planes.h"

namespace boxwood {
namespace {

/// What a node kind stores of the box, given the region that its parent guarantees and that it cuts.
template <class Word>
BoxSide store(SlabNode<Word>& node, const Box& box, Box& region) {
  const BoxSide side = cut_by_best_side(box, region);
  node.plane = side_of(region, side);
  return side;
}

template <class Word>
BoxSide store(BoxNode<Word>& node, const Box& box, Box& region) {
  node.bounds = box;
  region = box;
  return 0;
}

std::uint32_t depth_of(const Tree& tree) {
  std::vector<std::uint32_t> depths(tree.nodes.size());
  for (std::size_t i = 0; i < tree.nodes.size(); ++i) {
    const Tree::Node& node = tree.nodes[i];
    for (std::uint32_t c = node.first; !node.is_leaf() && c < node.first + node.count; ++c) depths[c] = depths[i] + 1;
  }
  return *std::ranges::max_element(depths);
}

template <class Nodes>
class Encoder {
 public:
  Encoder(const Tree& tree, Nodes& out) : tree_(tree), out_(out), pairs_(depth_first_places(tree, true)) {}

  void run() {
    std::vector<Box> regions(tree_.nodes.size());
    regions[0] = out_.root_box = tree_.nodes[0].bounds;
    out_.pairs.resize(tree_.nodes.size() - 1);
    out_.root = encode(tree_.nodes[0], pairs_[0], regions[0]);
    for (std::uint32_t i = 0; i < tree_.nodes.size(); ++i) {
      const Tree::Node& node = tree_.nodes[i];
      if (node.is_leaf()) continue;
      const bool swapped = !node.fixed_order && ascending_axis(tree_, node).swapped;
      for (std::uint32_t c = 0; c < 2; ++c) {
        const std::uint32_t child = node.first + (swapped ? 1 - c : c);
        regions[child] = regions[i];
        out_.pairs[2 * std::size_t{pairs_[i]} + c] = encode(tree_.nodes[child], pairs_[child], regions[child]);
      }
    }
  }

 private:
  using Node = typename Nodes::Node;

  Node encode(const Tree::Node& node, std::uint32_t pair, Box& region) const {
    Node out;
    const BoxSide side = store(out, node.bounds, region);
    using Word = decltype(out.word);
    out.word = node.is_leaf()
                   ? Word(node.first, SplitFlags::leaf(side))
                   : Word(pair, SplitFlags::inner(side, node.fixed_order ? 0 : ascending_axis(tree_, node).axis,
                                                  node.fixed_order));
    return out;
  }

  const Tree& tree_;
  Nodes& out_;
  std::vector<std::uint32_t> pairs_;
};

}  // namespace

AscendingAxis ascending_axis(const Tree& tree, const Tree::Node& node) {
  if (node.axis != Tree::mixed_axis) return {node.axis, false};
  const Vec3 apart = tree.nodes[node.first + 1].bounds.center() - tree.nodes[node.first].bounds.center();
  const auto axis =
      static_cast<std::uint32_t>(longest_axis({std::fabs(apart.x), std::fabs(apart.y), std::fabs(apart.z)}));
  return {axis, apart[axis] < 0};
}

template <class Nodes>
Nodes encode_split_nodes(const Tree& tree, std::string_view layout) {
  check_walkable(tree, 2, layout);
  Nodes out;
  if (tree.empty()) return out;
  const std::uint64_t most = decltype(out.root.word)::most_indices;
  if (reference_count(tree) > most || tree.nodes.size() / 2 > most) {
    throw Error(fmt::format("'{}' has room for {} triangles, not {}; take {}(index=64)", layout, most,
                            reference_count(tree), layout));
  }
  out.leaf_ends = LeafEnds(tree);
  out.stack_need = depth_of(tree) + 1;
  Encoder<Nodes>(tree, out).run();
  return out;
}

template SlabNodes32 encode_split_nodes(const Tree&, std::string_view);
template SlabNodes64 encode_split_nodes(const Tree&, std::string_view);
template BoxNodes32 encode_split_nodes(const Tree&, std::string_view);
template BoxNodes64 encode_split_nodes(const Tree&, std::string_view);

}  // namespace boxwood
