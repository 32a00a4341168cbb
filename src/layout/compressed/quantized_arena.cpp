#include "layout/compressed/quantized_arena.h"

#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstring>
#include <utility>

#include "boxwood/error.h"
#include "layout/compressed/quantize.h"
#include "layout/simd/tree_pieces.h"

namespace boxwood {
namespace {

constexpr std::size_t small_tree_bytes = std::size_t{1} << 20;

/// Calls visit(index, names of its triangles) for each leaf, in parallel.
template <class Visit>
void for_each_leaf(const Tree& tree, const Visit& visit) {
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, tree.nodes.size(), 1 << 8), [&](const auto& range) {
    for (std::size_t i = range.begin(); i < range.end(); ++i) {
      const Tree::Node& node = tree.nodes[i];
      if (node.is_leaf()) visit(i, std::span(tree.references).subspan(node.first, node.count));
    }
  });
}

/// Which leaves hold their own corners.
class LeafSizes {
 public:
  LeafSizes(const Tree& tree, const Mesh& mesh) : tree_(tree), mesh_(mesh), packed_(tree.nodes.size()) { measure(); }

  /// Whether packed leaves are tight.
  bool tight() const { return tight_; }

  /// Words of a leaf; a name takes one.
  std::size_t words(std::size_t leaf) const { return packed_[leaf] != 0 ? packed_[leaf] : tree_.nodes[leaf].count; }
  bool is_packed(std::size_t leaf) const { return packed_[leaf] != 0; }
  bool names_any() const {
    for (std::size_t i = 0; i < packed_.size(); ++i) {
      if (tree_.nodes[i].is_leaf() && !is_packed(i)) return true;
    }
    return false;
  }
  std::size_t total() const {
    std::size_t total = 0;
    for (std::size_t i = 0; i < packed_.size(); ++i) total += tree_.nodes[i].is_leaf() ? words(i) : 0;
    return total;
  }

  /// Brings all to no more than `most` words: packs leaves tight, and if that is not enough has leaves name their
  /// triangles, those first that rays meet least, by their area, for what packing them adds.
  void fit(std::size_t most) {
    if (total() <= most) return;
    tight_ = true;
    measure();
    if (total() <= most) return;
    std::vector<std::size_t> grown(buckets);
    for (std::size_t i = 0; i < packed_.size(); ++i) grown[bucket(i)] += growth(i);
    std::size_t total = tree_.references.size(), last = buckets - 1;
    while (total + grown[last] <= most) total += grown[last--];
    for (std::size_t i = 0; i < packed_.size(); ++i) {
      if (bucket(i) > last || growth(i) == 0) continue;
      if (bucket(i) == last && total + growth(i) <= most) {
        total += growth(i);
      } else {
        packed_[i] = 0;
      }
    }
  }

  /// Likewise among the children of each node, until no more than `most` words lie before the last leaf.
  void fit_nodes(std::size_t most) {
    for (const Tree::Node& node : tree_.nodes) {
      while (!node.is_leaf() && words_before_last(node) > most) {
        const auto end = node.first + node.count;
        auto largest = std::size_t{node.first};
        for (std::size_t i = node.first; i < end; ++i) largest = growth(i) > growth(largest) ? i : largest;
        if (growth(largest) == 0) break;
        packed_[largest] = 0;
      }
    }
  }

 private:
  void measure() {
    for_each_leaf(tree_, [&](std::size_t i, std::span<const std::uint32_t> names) {
      if (names.size() > most_triangles_in_parts) return;
      std::size_t words = 0;
      for_each_packed(names, mesh_, tight_, [&](const OwnCorners& part, bool) { words += part.words(); });
      packed_[i] = static_cast<std::uint8_t>(words);
    });
  }

  /// Words that packing takes beyond names.
  std::size_t growth(std::size_t i) const {
    return packed_[i] > tree_.nodes[i].count ? packed_[i] - tree_.nodes[i].count : 0u;
  }

  /// By how much area a leaf has for each word that packing adds, 64 steps for a factor of two: the upper bits of that
  /// quotient as a float.
  static constexpr std::size_t buckets = std::size_t{1} << 14;
  std::size_t bucket(std::size_t i) const {
    const float area = half_area(tree_.nodes[i].bounds) / static_cast<float>(std::max<std::size_t>(growth(i), 1));
    return std::bit_cast<std::uint32_t>(std::max(area, 0.0f)) >> 17;
  }

  std::size_t words_before_last(const Tree::Node& node) const {
    std::size_t before = 0, all = 0;
    for (std::size_t i = node.first; i < node.first + node.count; ++i) {
      if (!tree_.nodes[i].is_leaf()) continue;
      before = all;
      all += words(i);
    }
    return before;
  }

  const Tree& tree_;
  const Mesh& mesh_;
  bool tight_ = false;
  std::vector<std::uint8_t> packed_;  // words of leaves with corners of their own; 0 for others
};

/// Places inner nodes so that siblings are adjacent, and leaves, behind all nodes, so that sibling leaves are.
template <class Node>
class Encoder {
 public:
  Encoder(const Tree& tree, const Mesh& mesh, std::size_t bytes_per_triangle, QuantizedArena& out)
      : tree_(tree), mesh_(mesh), out_(out), sizes_(tree, mesh), places_(tree.nodes.size()) {
    const auto inner = static_cast<std::size_t>(
        std::ranges::count_if(tree.nodes, [](const Tree::Node& node) { return !node.is_leaf(); }));
    node_bytes_ = (inner + 2) * sizeof(Node);  // none at 0, and a root even of one leaf or nothing
    const std::size_t bytes = bytes_per_triangle * std::min(mesh.triangles.size(), tree.references.size());
    const std::size_t others = node_bytes_ + words_at_once * sizeof(std::uint32_t);
    sizes_.fit((bytes - std::min(bytes, others)) / sizeof(std::uint32_t));
    if (sizeof(Node) == sizeof(QuantizedNode8)) sizes_.fit_nodes(no_child - 1);
    out_.memory = Arena(node_bytes_ + (sizes_.total() + words_at_once) * sizeof(std::uint32_t));
    words_ = reinterpret_cast<std::uint32_t*>(out_.memory.data());
    next_leaf_ = static_cast<std::uint32_t>(node_bytes_ / sizeof(std::uint32_t));
  }

  void run() {
    Node& root = node_at(take_node());
    if (tree_.empty()) {
      write(root, {}, {});
    } else if (tree_.nodes[0].is_leaf()) {
      write(root, tree_.nodes[0].bounds, {&tree_.nodes[0], 1});
    } else {
      places_[0] = words_per_node;
      write_inner_nodes();
    }
    write_leaves();
  }

  std::size_t node_bytes() const { return node_bytes_; }
  bool tight() const { return sizes_.tight(); }
  /// Whether any leaf only names triangles.
  bool needs_mesh() const { return sizes_.names_any(); }

 private:
  static constexpr std::uint32_t words_per_node = sizeof(Node) / sizeof(std::uint32_t);

  Node& node_at(std::uint32_t word) { return *reinterpret_cast<Node*>(words_ + word); }
  std::uint32_t take_node() { return std::exchange(next_node_, next_node_ + words_per_node); }

  void write_inner_nodes() {
    std::vector<std::uint32_t> pending = {0};
    while (!pending.empty()) {
      const std::uint32_t i = pending.back();
      pending.pop_back();
      const Tree::Node& node = tree_.nodes[i];
      const auto children = std::span(tree_.nodes).subspan(node.first, node.count);
      Box box;
      for (const Tree::Node& child : children) box.grow(child.bounds);
      write(node_at(places_[i]), box, children);
      for (std::uint32_t c = node.count; c-- > 0;) {
        if (!children[c].is_leaf()) pending.push_back(node.first + c);
      }
    }
  }

  /// Takes room for a child.
  std::uint32_t place(const Tree::Node& child) {
    const auto index = static_cast<std::size_t>(&child - tree_.nodes.data());
    if (!child.is_leaf()) return places_[index] = take_node();
    places_[index] = next_leaf_;
    next_leaf_ += static_cast<std::uint32_t>(sizes_.words(index));
    return places_[index];
  }

  void write_leaves() {
    for_each_leaf(tree_, [&](std::size_t i, std::span<const std::uint32_t> names) {
      std::uint32_t* out = words_ + places_[i];
      if (sizes_.is_packed(i)) {
        for_each_packed(names, mesh_, sizes_.tight(), [&](const OwnCorners& part, bool more) {
          part.pack(out, more);
          out += part.words();
        });
      } else {
        std::ranges::copy(names, out);
        out[names.size() - 1] |= last_of_leaf;
      }
    });
  }

  void write_boxes(Node& node, const Box& box, std::span<const Tree::Node> children) {
    std::memset(static_cast<void*>(&node), 0, sizeof node);
    if (children.empty()) return;
    const Grid grid = grid_over(box, bits_of_step<Node>);
    set_grid(grid, node);
    for (std::size_t axis = 0; axis < 3; ++axis) {
      for (std::size_t c = 0; c < children.size(); ++c) {
        node.planes[2 * axis][c] = round_down(grid, axis, children[c].bounds.lower[axis]);
        node.planes[2 * axis + 1][c] = round_up(grid, axis, children[c].bounds.upper[axis]);
      }
    }
  }

  void write(QuantizedNode16& node, const Box& box, std::span<const Tree::Node> children) {
    write_boxes(node, box, children);
    for (std::size_t c = 0; c < children.size(); ++c) {
      node.children[c] = place(children[c]) * 2 + (children[c].is_leaf() ? 1 : 0);
    }
  }

  void write(QuantizedNode8& node, const Box& box, std::span<const Tree::Node> children) {
    write_boxes(node, box, children);
    std::ranges::fill(node.place, static_cast<std::uint8_t>(no_child));
    node.first_node = next_node_ * 2;
    node.first_leaf = next_leaf_ * 2 + 1;
    for (std::size_t c = 0; c < children.size(); ++c) {
      const bool leaf = children[c].is_leaf();
      const std::uint32_t distance = place(children[c]) - (leaf ? node.first_leaf : node.first_node) / 2;
      if (distance >= no_child) {
        throw UsageError(fmt::format(
            "'compressed(8)' has room for {} triangles before the last leaf of a node, not {}; make smaller "
            "leaves or use compressed(16)",
            no_child - 1, distance));
      }
      node.place[c] = static_cast<std::uint8_t>(distance);
      if (!leaf) node.inner = static_cast<std::uint8_t>(node.inner | 1u << c);
    }
  }

  const Tree& tree_;
  const Mesh& mesh_;
  QuantizedArena& out_;
  LeafSizes sizes_;
  std::size_t node_bytes_ = 0;
  std::uint32_t* words_ = nullptr;
  std::vector<std::uint32_t> places_;  // first words of nodes and leaves
  std::uint32_t next_node_ = words_per_node, next_leaf_ = 0;
};

float reach_of_box(const Box& box) {
  float reach = 0;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    reach = std::max({reach, std::fabs(box.lower[axis]), std::fabs(box.upper[axis])});
  }
  return reach;
}

}  // namespace

bool has_quantized_names(const Tree& tree, const Mesh& mesh, std::size_t bytes) {
  constexpr std::size_t most_words = std::size_t{1} << 31, words_per_node = sizeof(QuantizedNode16) / 4;
  return (tree.nodes.size() + 2) * words_per_node + tree.references.size() * std::max<std::size_t>(bytes, 4) / 4 <
             most_words &&
         mesh.triangles.size() <= packed_leaf;
}

WideView quantized_view(const std::byte* memory, std::size_t node_bytes, std::span<const Vec3> positions,
                        std::span<const Triangle> triangles) {
  WideView view;
  view.base = memory;
  view.root = quantized_root(node_bytes);
  view.positions = positions.data();
  view.triangles = triangles.data();
  return view;
}

bool fits_eight(const Tree& tree) {
  return std::ranges::all_of(tree.nodes, [&](const Tree::Node& node) {
    if (node.is_leaf()) return true;
    std::uint32_t before = 0, primitives = 0;
    for (const Tree::Node& child : std::span(tree.nodes).subspan(node.first, node.count)) {
      if (!child.is_leaf()) continue;
      before = primitives;
      primitives += child.count;
    }
    return before < no_child;
  });
}

template <class Node>
QuantizedArena encode_quantized(const Tree& tree, const Mesh& mesh, std::size_t bytes) {
  QuantizedArena out;
  Encoder<Node> encoder(tree, mesh, bytes, out);
  encoder.run();
  out.shape.lanes = sizeof(Node::planes[0]);
  if (!tree.empty()) {
    out.shape = {encoder.node_bytes() / sizeof(Node) - (tree.nodes[0].is_leaf() ? 1 : 2), encoder.node_bytes(),
                 sizeof(Node::planes[0]), std::max<std::size_t>(tree.nodes.size() - 1, 1), tree.references.size()};
  }
  out.positions = mesh.positions;
  out.triangles = mesh.triangles;
  out.bounds = tree.empty() ? Box{} : tree.nodes[0].bounds;
  out.view = quantized_view(out.memory.data(), sizeof(Node), out.positions, out.triangles);
  out.view.tight = encoder.tight();
  if (!encoder.needs_mesh()) out.view.positions = nullptr;
  out.view.reach = tree.empty() ? 0 : reach_of_box(out.bounds);
  out.view.stack = needs_of(tree).stack;
  out.view.out_of_cache = out.bytes() + mesh.positions.size() * sizeof(Vec3) > small_tree_bytes;
  return out;
}

template QuantizedArena encode_quantized<QuantizedNode8>(const Tree&, const Mesh&, std::size_t);
template QuantizedArena encode_quantized<QuantizedNode16>(const Tree&, const Mesh&, std::size_t);

}  // namespace boxwood
