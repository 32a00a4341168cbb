#include "layout/simd/wide_arena.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <span>
#include <vector>

#include "layout/simd/arena_writers.h"
#include "layout/simd/tree_pieces.h"
#include "tree/tree.h"

namespace boxwood {
namespace {

constexpr std::size_t cache_line = 64;
constexpr std::size_t small_tree_bytes = std::size_t{1} << 20;

constexpr std::size_t round_up(std::size_t value, std::size_t unit) { return (value + unit - 1) / unit * unit; }

/// Where everything goes. A node's children lie together: inner ones first, then the blocks of its leaves, padded to a
/// cache line. Such clusters follow each other depth first.
template <int N, int L>
class Placement {
 public:
  explicit Placement(const Tree& tree) : tree_(tree), pieces_(cut_into_pieces(tree)), begins_(pieces_.size() + 1) {
    std::vector<WalkNeeds> needs(pieces_.size());
    std::vector<std::size_t> inner_nodes(pieces_.size());
    tbb::parallel_for(std::size_t{0}, pieces_.size(), [&](std::size_t p) {
      walk_piece(tree, pieces_[p], pieces_[p].open, [&](const Tree::Node& node, std::uint32_t open, const auto& push) {
        begins_[p + 1] += measure(node, needs[p].enter(node, open), push);
        ++inner_nodes[p];
      });
    });
    begins_[0] = root_place + sizeof(WideNode<N>);
    for (std::size_t p = 0; p < pieces_.size(); ++p) {
      begins_[p + 1] += begins_[p];
      needs_ += needs[p];
      inner_nodes_ += inner_nodes[p];
    }
    if (pieces_.empty() && !tree.empty()) begins_[0] += round_up(LeafWriter<L>::bytes(tree.nodes[0]), cache_line);
  }

  std::size_t bytes() const { return begins_.back(); }
  std::size_t inner_nodes() const { return inner_nodes_; }
  const WalkNeeds& needs() const { return needs_; }

  /// Writes every byte: `base` may hold anything.
  void write(const Mesh& mesh, std::byte* base) const {
    const LeafWriter<L> leaves(tree_, mesh);
    std::fill_n(base, root_place, std::byte{0});
    if (pieces_.empty()) return write_root_of_leaf(leaves, base);
    tbb::parallel_for(std::size_t{0}, pieces_.size(), [&](std::size_t p) {
      const TreePiece& piece = pieces_[p];
      const std::size_t place = p == 0 ? root_place : begins_[piece.parent] + piece.rank * sizeof(WideNode<N>);
      std::size_t next_cluster = begins_[p];
      walk_piece(tree_, piece, place, [&](const Tree::Node& node, std::size_t at, const auto& push) {
        next_cluster = write_cluster(node, leaves, base, at, next_cluster, push);
      });
    });
  }

 private:
  static constexpr std::size_t root_place = cache_line;

  std::span<const Tree::Node> children_of(const Tree::Node& node) const {
    return std::span(tree_.nodes).subspan(node.first, node.count);
  }

  /// Bytes of a node's cluster. Pushes the inner children.
  template <class Push>
  std::size_t measure(const Tree::Node& node, std::uint32_t open, const Push& push) const {
    std::size_t nodes = 0, leaves = 0;
    for (std::uint32_t c = node.first + node.count; c-- > node.first;) {
      const Tree::Node& child = tree_.nodes[c];
      if (child.is_leaf()) {
        leaves += LeafWriter<L>::bytes(child);
      } else {
        nodes += sizeof(WideNode<N>);
        push(c, open);
      }
    }
    return nodes + round_up(leaves, cache_line);
  }

  /// Writes the node to `place` and the leaves among its children to their cluster at `begin`. Pushes the inner
  /// children with their places. Returns the cluster's end.
  template <class Push>
  std::size_t write_cluster(const Tree::Node& node, const LeafWriter<L>& leaves, std::byte* base, std::size_t place,
                            std::size_t begin, const Push& push) const {
    const std::span<const Tree::Node> children = children_of(node);
    const auto inner = static_cast<std::size_t>(
        std::ranges::count_if(children, [](const Tree::Node& child) { return !child.is_leaf(); }));
    const std::size_t leaves_begin = begin + inner * sizeof(WideNode<N>);
    std::size_t next_node = begin, next_leaf = leaves_begin;
    NodeWriter<N> writer;
    for (const Tree::Node& child : children) {
      std::size_t& next = child.is_leaf() ? next_leaf : next_node;
      writer.add(child, wide_reference(next, child.is_leaf()));
      if (child.is_leaf()) leaves.write(child, base + next);
      next += child.is_leaf() ? LeafWriter<L>::bytes(child) : sizeof(WideNode<N>);
    }
    writer.write(base + place);
    for (std::uint32_t c = node.count; c-- > 0;) {
      if (!children[c].is_leaf()) push(node.first + c, next_node -= sizeof(WideNode<N>));
    }
    return end_of_leaves(base, leaves_begin, next_leaf);
  }

  /// The end of a cluster, zero up to there.
  static std::size_t end_of_leaves(std::byte* base, std::size_t begin, std::size_t end) {
    const std::size_t padded = begin + round_up(end - begin, cache_line);
    std::fill(base + end, base + padded, std::byte{0});
    return padded;
  }

  void write_root_of_leaf(const LeafWriter<L>& leaves, std::byte* base) const {
    constexpr std::size_t leaf_place = root_place + sizeof(WideNode<N>);
    NodeWriter<N> root;
    if (!tree_.empty()) {
      root.add(tree_.nodes[0], wide_reference(leaf_place, true));
      leaves.write(tree_.nodes[0], base + leaf_place);
      end_of_leaves(base, leaf_place, leaf_place + LeafWriter<L>::bytes(tree_.nodes[0]));
    }
    root.write(base + root_place);
  }

  const Tree& tree_;
  std::vector<TreePiece> pieces_;
  std::vector<std::size_t> begins_;  ///< of each piece's clusters, and the end of all
  WalkNeeds needs_;
  std::size_t inner_nodes_ = 0;
};

float reach_of(const Tree& tree) {
  float reach = 0;
  if (tree.empty()) return reach;
  const Box& box = tree.nodes[0].bounds;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    reach = std::max({reach, std::fabs(box.lower[axis]), std::fabs(box.upper[axis])});
  }
  return reach;
}

}  // namespace

std::vector<LayoutFact> WideShape::facts(std::size_t bytes) const {
  return {{"topology_bytes", static_cast<double>(node_bytes)},
          {"leaf_bytes", static_cast<double>(bytes - node_bytes)},
          {"lane_fill", static_cast<double>(children), static_cast<double>(nodes * lanes)}};
}

/// Leaves of full blocks, without padding, are 40 bytes per triangle.
std::vector<LayoutFact> wide_facts(const WideShape& shape, std::size_t bytes) {
  std::vector<LayoutFact> facts = shape.facts(bytes);
  facts.push_back(
      {"leaf_fill", 40 * static_cast<double>(shape.triangles), static_cast<double>(bytes - shape.node_bytes)});
  return facts;
}

template <int N, int L>
std::optional<WideArena> encode_wide(const Tree& tree, const Mesh& mesh) {
  const Placement<N, L> placement(tree);
  const WalkNeeds& needs = placement.needs();
  if (needs.widest > N || needs.fixed_order || needs.stack > wide_stack_limit) return {};
  WideArena out{Arena(placement.bytes(), Holds::anything), {}, {}};
  out.view = {out.memory.data(), wide_reference(cache_line, false), reach_of(tree), needs.stack,
              placement.bytes() > small_tree_bytes};
  const std::size_t nodes = std::max<std::size_t>(placement.inner_nodes(), 1);  // a leaf alone has a node above it
  if (!tree.empty()) {
    out.shape = {nodes, nodes * sizeof(WideNode<N>), N, std::max<std::size_t>(tree.nodes.size() - 1, 1),
                 tree.references.size()};
  }
  placement.write(mesh, out.memory.data());
  return out;
}

template <int N, int L>
void refit_wide(WideArena& arena, const Tree& tree, const Mesh& mesh) {
  arena.view.reach = reach_of(tree);
  Placement<N, L>(tree).write(mesh, arena.memory.data());
}

template std::optional<WideArena> encode_wide<4, 4>(const Tree&, const Mesh&);
template std::optional<WideArena> encode_wide<8, 4>(const Tree&, const Mesh&);
template std::optional<WideArena> encode_wide<8, 8>(const Tree&, const Mesh&);
template std::optional<WideArena> encode_wide<16, 8>(const Tree&, const Mesh&);
template void refit_wide<4, 4>(WideArena&, const Tree&, const Mesh&);
template void refit_wide<8, 4>(WideArena&, const Tree&, const Mesh&);
template void refit_wide<16, 8>(WideArena&, const Tree&, const Mesh&);

}  // namespace boxwood
