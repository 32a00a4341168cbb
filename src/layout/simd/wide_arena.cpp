#include "layout/simd/wide_arena.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <new>
#include <vector>

#include "tree/tree.h"

namespace boxwood {
namespace {

constexpr std::size_t cache_line = 64;
constexpr std::size_t small_tree_bytes = std::size_t{4} << 20;

constexpr std::size_t round_up(std::size_t value, std::size_t unit) { return (value + unit - 1) / unit * unit; }

/// Where everything goes. A node's children lie together: inner ones first, then the blocks of its leaves, padded to a
/// cache line. Clusters follow each other depth first.
template <int N, int L>
class Placement {
 public:
  explicit Placement(const Tree& tree) : tree_(tree), places_(tree.nodes.size()) {
    measure_subtrees();
    assign_places();
  }

  std::size_t bytes() const { return bytes_; }
  std::size_t inner_nodes() const { return inner_nodes_; }
  /// Byte offset of a node, or of a leaf's first block.
  std::size_t place(std::size_t node) const { return places_[node] * cache_granule; }

  static std::size_t leaf_bytes(const Tree::Node& leaf) { return (leaf.count + L - 1) / L * sizeof(LeafBlock<L>); }

 private:
  static constexpr std::size_t cache_granule = wide_granule;

  std::size_t cluster_bytes(const Tree::Node& parent) const {
    std::size_t nodes = 0, leaves = 0;
    for (std::uint32_t i = 0; i < parent.count; ++i) {
      const Tree::Node& child = tree_.nodes[parent.first + i];
      (child.is_leaf() ? leaves : nodes) += child.is_leaf() ? leaf_bytes(child) : sizeof(WideNode<N>);
    }
    return nodes + round_up(leaves, cache_line);
  }

  // First, places_[i] is the size in granules of everything below node i. Children follow their parents in the array.
  void measure_subtrees() {
    for (std::size_t i = tree_.nodes.size(); i-- > 0;) {
      const Tree::Node& node = tree_.nodes[i];
      if (node.is_leaf()) continue;
      ++inner_nodes_;
      std::size_t size = cluster_bytes(node) / cache_granule;
      for (std::uint32_t c = 0; c < node.count; ++c) size += places_[node.first + c];
      places_[i] = size;
    }
  }

  // Then sizes become places, parents before children: `below` holds where the cluster of an inner node begins.
  void assign_places() {
    const std::size_t root_place = cache_line / cache_granule;
    const std::size_t root_end = root_place + sizeof(WideNode<N>) / cache_granule;
    if (tree_.nodes.empty()) {
      bytes_ = root_end * cache_granule;
      return;
    }
    std::vector<std::size_t> below(tree_.nodes.size());
    const Tree::Node& root = tree_.nodes[0];
    const std::size_t root_size = root.is_leaf() ? round_up(leaf_bytes(root), cache_line) / cache_granule : places_[0];
    bytes_ = (root_end + root_size) * cache_granule;
    places_[0] = root.is_leaf() ? root_end : root_place;
    below[0] = root_end;
    for (std::size_t i = 0; i < tree_.nodes.size(); ++i) {
      if (!tree_.nodes[i].is_leaf()) place_children(tree_.nodes[i], below[i], below);
    }
  }

  void place_children(const Tree::Node& node, std::size_t begin, std::vector<std::size_t>& below) {
    std::size_t next_cluster = begin + cluster_bytes(node) / cache_granule;
    std::size_t next = begin;
    for (const bool leaves : {false, true}) {
      for (std::uint32_t c = node.first; c < node.first + node.count; ++c) {
        const Tree::Node& child = tree_.nodes[c];
        if (child.is_leaf() != leaves) continue;
        const std::size_t subtree = places_[c];
        places_[c] = next;
        next += (leaves ? leaf_bytes(child) : sizeof(WideNode<N>)) / cache_granule;
        if (leaves) continue;
        below[c] = next_cluster;
        next_cluster += subtree;
      }
    }
  }

  const Tree& tree_;
  std::vector<std::size_t> places_;
  std::size_t bytes_ = 0, inner_nodes_ = 0;
};

template <int N>
void set_lane(WideNode<N>& node, int lane, const Box& box, WideReference child) {
  for (std::size_t axis = 0; axis < 3; ++axis) {
    node.planes[2 * axis][lane] = box.lower[axis];
    node.planes[2 * axis + 1][lane] = box.upper[axis];
  }
  node.children[lane] = child;
}

/// A node without children, constructed at `place`.
template <int N>
WideNode<N>& empty_node(std::byte* place) {
  WideNode<N>& node = *new (place) WideNode<N>;
  for (int lane = 0; lane < N; ++lane) set_lane(node, lane, Box{}, wide_nothing);
  return node;
}

template <int L>
void write_block(LeafBlock<L>& block, const Mesh& mesh, const std::uint32_t* primitives, std::size_t count, bool more) {
  for (std::size_t lane = 0; lane < L; ++lane) {
    const bool used = lane < count;
    const std::uint32_t primitive = primitives[used ? lane : 0];
    const Triangle& triangle = mesh.triangles[primitive];
    for (std::size_t vertex = 0; vertex < 3; ++vertex) {
      const Vec3& position = mesh.positions[triangle[used ? vertex : 0]];
      for (std::size_t axis = 0; axis < 3; ++axis) block.vertices[vertex][axis][lane] = position[axis];
    }
    block.primitives[lane] = primitive;
  }
  if (more) block.primitives[0] |= more_blocks;
}

template <int L>
void write_leaf(std::byte* place, const Tree& tree, const Tree::Node& leaf, const Mesh& mesh) {
  for (std::size_t done = 0; done < leaf.count; done += L, place += sizeof(LeafBlock<L>)) {
    const std::size_t left = leaf.count - done;
    write_block(*new (place) LeafBlock<L>, mesh, tree.references.data() + leaf.first + done,
                std::min<std::size_t>(left, L), left > L);
  }
}

float reach_of_box(const Box& box) {
  float reach = 0;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    reach = std::max({reach, std::fabs(box.lower[axis]), std::fabs(box.upper[axis])});
  }
  return reach;
}

/// Nodes and leaves, and the bound on coordinates that they have.
template <int N, int L>
void write_tree(const Placement<N, L>& placement, const Tree& tree, const Mesh& mesh, WideArena& out) {
  std::byte* base = out.memory.data();
  WideNode<N>& root = empty_node<N>(base + cache_line);
  if (tree.empty()) return;
  out.view.reach = reach_of_box(tree.nodes[0].bounds);
  if (tree.nodes[0].is_leaf()) {
    set_lane(root, 0, tree.nodes[0].bounds, wide_reference(placement.place(0), true));
  }
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, tree.nodes.size(), 1024), [&](const auto& range) {
    for (std::size_t i = range.begin(); i != range.end(); ++i) {
      const Tree::Node& node = tree.nodes[i];
      if (node.is_leaf()) {
        write_leaf<L>(base + placement.place(i), tree, node, mesh);
        continue;
      }
      WideNode<N>& wide = empty_node<N>(base + placement.place(i));
      for (std::uint32_t c = 0; c < node.count; ++c) {
        const Tree::Node& child = tree.nodes[node.first + c];
        set_lane(wide, static_cast<int>(c), child.bounds,
                 wide_reference(placement.place(node.first + c), child.is_leaf()));
      }
    }
  });
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

std::uint32_t stack_need(const Tree& tree) {
  std::vector<std::uint32_t> need(tree.nodes.size(), 1);
  std::uint32_t most = 1;
  for (std::size_t i = 0; i < tree.nodes.size(); ++i) {
    const Tree::Node& node = tree.nodes[i];
    if (node.is_leaf()) continue;
    const std::uint32_t below = std::min(need[i] + node.count - 1, Tree::max_count);
    most = std::max(most, below);
    std::fill_n(need.begin() + node.first, node.count, below);
  }
  return most;
}

template <int N, int L>
WideArena encode_wide(const Tree& tree, const Mesh& mesh) {
  const Placement<N, L> placement(tree);
  WideArena out{Arena(placement.bytes()), {}, {}};
  out.view = {out.memory.data(), wide_reference(cache_line, false), 0, stack_need(tree),
              placement.bytes() > small_tree_bytes};
  const std::size_t nodes = std::max<std::size_t>(placement.inner_nodes(), 1);  // a leaf alone has a node above it
  if (!tree.empty()) {
    out.shape = {nodes, nodes * sizeof(WideNode<N>), N, std::max<std::size_t>(tree.nodes.size() - 1, 1),
                 tree.references.size()};
  }
  write_tree(placement, tree, mesh, out);
  return out;
}

template <int N, int L>
void refit_wide(WideArena& arena, const Tree& tree, const Mesh& mesh) {
  write_tree(Placement<N, L>(tree), tree, mesh, arena);
}

template WideArena encode_wide<4, 4>(const Tree&, const Mesh&);
template WideArena encode_wide<8, 4>(const Tree&, const Mesh&);
template WideArena encode_wide<8, 8>(const Tree&, const Mesh&);
template WideArena encode_wide<16, 8>(const Tree&, const Mesh&);
template void refit_wide<4, 4>(WideArena&, const Tree&, const Mesh&);
template void refit_wide<8, 4>(WideArena&, const Tree&, const Mesh&);
template void refit_wide<16, 8>(WideArena&, const Tree&, const Mesh&);

}  // namespace boxwood
