#include "layout/simd/wide_arena.h"

#include <fmt/format.h>
#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <new>

#include "boxwood/error.h"
#include "math/large_memory.h"
#include "tree/tree.h"

namespace boxwood {
namespace {

constexpr std::size_t cache_line = 64;
constexpr std::size_t small_tree_bytes = std::size_t{4} << 20;

constexpr std::size_t round_up(std::size_t value, std::size_t unit) { return (value + unit - 1) / unit * unit; }

/// Where everything goes, in granules. A node's children lie together: inner ones first, then the blocks of its leaves,
/// padded to a cache line. Clusters follow each other depth first.
template <int N, int L>
class Placement {
 public:
  explicit Placement(const Tree& tree) : tree_(tree), places_(tree.nodes.size()) {
    measure_subtrees();
    assign_places();
  }

  std::size_t bytes() const { return end_ * wide_granule; }
  /// Byte offset of a node, or of a leaf's first block.
  std::size_t place(std::size_t node) const { return places_[node] * wide_granule; }

  static std::size_t leaf_bytes(const Tree::Node& leaf) { return (leaf.count + L - 1) / L * sizeof(LeafBlock<L>); }

 private:
  // Granules are counted in 32 bits, as references count them.
  static constexpr std::uint32_t line = cache_line / wide_granule;
  static constexpr std::uint32_t node_size = sizeof(WideNode<N>) / wide_granule;
  static std::uint32_t leaf_size(const Tree::Node& leaf) {
    return static_cast<std::uint32_t>(leaf_bytes(leaf) / wide_granule);
  }

  std::uint32_t cluster_size(const Tree::Node& parent) const {
    std::uint32_t nodes = 0, leaves = 0;
    for (std::uint32_t i = 0; i < parent.count; ++i) {
      const Tree::Node& child = tree_.nodes[parent.first + i];
      (child.is_leaf() ? leaves : nodes) += child.is_leaf() ? leaf_size(child) : node_size;
    }
    return nodes + static_cast<std::uint32_t>(round_up(leaves, line));
  }

  // First, places_[i] is the size of everything below node i. Children follow their parents in the array.
  void measure_subtrees() {
    end_ = line + node_size;
    for (std::size_t i = tree_.nodes.size(); i-- > 0;) {
      const Tree::Node& node = tree_.nodes[i];
      places_[i] = 0;
      if (node.is_leaf()) continue;
      const std::uint32_t cluster = cluster_size(node);
      end_ += cluster;
      places_[i] = cluster;
      for (std::uint32_t c = 0; c < node.count; ++c) places_[i] += places_[node.first + c];
    }
    if (!tree_.nodes.empty() && tree_.nodes[0].is_leaf()) end_ += round_up(leaf_size(tree_.nodes[0]), line);
    if (end_ >= std::size_t{1} << 31) {
      throw Error(fmt::format("a wide structure of {} bytes cannot be addressed, the most is {}; split the scene",
                              bytes(), wide_granule << 31));
    }
  }

  // Then sizes become places, parents before children: `below` holds where the cluster of an inner node begins.
  void assign_places() {
    if (tree_.nodes.empty()) return;
    RawArray<std::uint32_t> below(tree_.nodes.size());
    below[0] = line + node_size;
    places_[0] = tree_.nodes[0].is_leaf() ? below[0] : line;
    for (std::size_t i = 0; i < tree_.nodes.size(); ++i) {
      if (!tree_.nodes[i].is_leaf()) place_children(tree_.nodes[i], below[i], below);
    }
  }

  void place_children(const Tree::Node& node, std::uint32_t begin, RawArray<std::uint32_t>& below) {
    std::uint32_t next_node = begin, next_leaf = begin, next_cluster = begin + cluster_size(node);
    for (std::uint32_t c = node.first; c < node.first + node.count; ++c) {
      next_leaf += tree_.nodes[c].is_leaf() ? 0 : node_size;
    }
    for (std::uint32_t c = node.first; c < node.first + node.count; ++c) {
      const Tree::Node& child = tree_.nodes[c];
      if (child.is_leaf()) {
        places_[c] = next_leaf;
        next_leaf += leaf_size(child);
      } else {
        below[c] = next_cluster;
        next_cluster += places_[c];
        places_[c] = next_node;
        next_node += node_size;
      }
    }
  }

  const Tree& tree_;
  RawArray<std::uint32_t> places_;
  std::size_t end_ = 0;
};

template <int N>
void set_lane(WideNode<N>& node, int lane, const Box& box, WideReference child) {
  for (std::size_t axis = 0; axis < 3; ++axis) {
    node.planes[2 * axis][lane] = box.lower[axis];
    node.planes[2 * axis + 1][lane] = box.upper[axis];
  }
  node.children[lane] = child;
}

/// A node whose first lanes are still to be set, constructed at `place`.
template <int N>
WideNode<N>& new_node(std::byte* place, std::uint32_t children) {
  WideNode<N>& node = *new (place) WideNode<N>;
  for (int lane = static_cast<int>(children); lane < N; ++lane) set_lane(node, lane, Box{}, wide_nothing);
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

/// Starts the cache misses of leaves that are written soon: triangles first, their corners later.
void prefetch_triangles(const Tree& tree, std::size_t reference, const Mesh& mesh) {
  constexpr std::size_t triangle_distance = 32, corner_distance = 16, step = 4;
  if (reference + triangle_distance + step > tree.references.size()) return;
  for (std::size_t i = reference; i < reference + step; ++i) {
    __builtin_prefetch(&mesh.triangles[tree.references[i + triangle_distance]]);
    for (const std::uint32_t corner : mesh.triangles[tree.references[i + corner_distance]]) {
      __builtin_prefetch(&mesh.positions[corner]);
    }
  }
}

template <int L>
void write_leaf(std::byte* place, const Tree& tree, const Tree::Node& leaf, const Mesh& mesh) {
  prefetch_triangles(tree, leaf.first, mesh);
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

}  // namespace

std::uint32_t stack_need(const Tree& tree) {
  if (tree.nodes.empty()) return 1;
  RawArray<std::uint32_t> need(tree.nodes.size());
  need[0] = 1;
  std::uint32_t most = 1;
  for (std::size_t i = 0; i < tree.nodes.size(); ++i) {
    const Tree::Node& node = tree.nodes[i];
    if (node.is_leaf()) continue;
    const std::uint32_t below = std::min(need[i] + node.count - 1, Tree::max_count);
    most = std::max(most, below);
    std::fill_n(need.data() + node.first, node.count, below);
  }
  return most;
}

template <int N, int L>
WideArena encode_wide(const Tree& tree, const Mesh& mesh) {
  const Placement<N, L> placement(tree);
  WideArena out{Arena(placement.bytes()), {}};
  std::byte* base = out.memory.data();
  out.view = {base, wide_reference(cache_line, false), 0, stack_need(tree), placement.bytes() > small_tree_bytes};
  if (tree.empty() || tree.nodes[0].is_leaf()) {
    WideNode<N>& root = new_node<N>(base + cache_line, 0);
    if (tree.empty()) return out;
    set_lane(root, 0, tree.nodes[0].bounds, wide_reference(placement.place(0), true));
  }
  out.view.reach = reach_of_box(tree.nodes[0].bounds);
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, tree.nodes.size(), 1024), [&](const auto& range) {
    for (std::size_t i = range.begin(); i != range.end(); ++i) {
      const Tree::Node& node = tree.nodes[i];
      if (node.is_leaf()) {
        write_leaf<L>(base + placement.place(i), tree, node, mesh);
        continue;
      }
      WideNode<N>& wide = new_node<N>(base + placement.place(i), node.count);
      for (std::uint32_t c = 0; c < node.count; ++c) {
        const Tree::Node& child = tree.nodes[node.first + c];
        const std::size_t place = placement.place(node.first + c);
        set_lane(wide, static_cast<int>(c), child.bounds, wide_reference(place, child.is_leaf()));
      }
    }
  });
  return out;
}

template WideArena encode_wide<4, 4>(const Tree&, const Mesh&);
template WideArena encode_wide<8, 4>(const Tree&, const Mesh&);
template WideArena encode_wide<8, 8>(const Tree&, const Mesh&);
template WideArena encode_wide<16, 8>(const Tree&, const Mesh&);

}  // namespace boxwood
