#include "layout/compressed/quantized_arena.h"

#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>

#include "boxwood/error.h"
#include "layout/compressed/quantize.h"
#include "layout/simd/tree_pieces.h"

namespace boxwood {
namespace {

constexpr std::size_t small_tree_bytes = std::size_t{4} << 20;

std::span<const std::uint32_t> names_of(const Tree& tree, const Tree::Node& leaf) {
  return std::span(tree.references).subspan(leaf.first, leaf.count);
}

/// Which leaves hold their own corners.
class LeafSizes {
 public:
  LeafSizes(const Tree& tree, const Mesh& mesh) : tree_(tree), packed_(tree.nodes.size()) {
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, tree.nodes.size(), 1 << 8), [&](const auto& range) {
      for (std::size_t i = range.begin(); i < range.end(); ++i) {
        if (!tree.nodes[i].is_leaf()) continue;
        const std::optional<OwnCorners> corners = OwnCorners::of(names_of(tree, tree.nodes[i]), mesh);
        packed_[i] = static_cast<std::uint8_t>(corners ? corners->words() : 0);
      }
    });
  }

  /// Words of a leaf; a name takes one.
  std::size_t words(std::size_t leaf) const { return packed_[leaf] != 0 ? packed_[leaf] : tree_.nodes[leaf].count; }
  bool is_packed(std::size_t leaf) const { return packed_[leaf] != 0; }
  void unpack(std::size_t leaf) { packed_[leaf] = 0; }

  /// Words that packing takes beyond names.
  std::size_t growth(std::size_t leaf) const {
    return words(leaf) - std::min<std::size_t>(words(leaf), tree_.nodes[leaf].count);
  }

  /// Has leaves that grow by more than what the rest leave room for name their triangles.
  void fit(std::size_t most_words) {
    std::array<std::size_t, 256> grown{};
    std::size_t total = tree_.references.size();
    for (std::size_t i = 0; i < packed_.size(); ++i) grown[growth(i)] += growth(i);
    std::size_t most_growth = 0;
    while (most_growth < grown.size() && total + grown[most_growth] <= most_words) total += grown[most_growth++];
    for (std::size_t i = 0; i < packed_.size(); ++i) {
      if (growth(i) >= most_growth) unpack(i);
    }
  }

 private:
  const Tree& tree_;
  std::vector<std::uint8_t> packed_;  // words of leaves with corners of their own; 0 for others
};

/// Numbers inner nodes so that siblings are adjacent, and places leaves so that sibling leaves are.
template <class Node>
class Encoder {
 public:
  Encoder(const Tree& tree, const Mesh& mesh, QuantizedArena& out)
      : tree_(tree), mesh_(mesh), out_(out), sizes_(tree, mesh), places_(tree.nodes.size()) {
    const auto inner = static_cast<std::size_t>(
        std::ranges::count_if(tree.nodes, [](const Tree::Node& node) { return !node.is_leaf(); }));
    out_.nodes = Arena((inner + 2) * sizeof(Node));  // none at 0, and a root even of one leaf or nothing
    nodes_ = reinterpret_cast<Node*>(out_.nodes.data());
  }

  void run() {
    const std::size_t bytes = bytes_per_triangle * std::min(mesh_.triangles.size(), tree_.references.size());
    sizes_.fit((bytes - std::min(bytes, out_.nodes.bytes())) / sizeof(std::uint32_t));
    if (tree_.empty()) {
      write(nodes_[1], {}, {});
    } else if (tree_.nodes[0].is_leaf()) {
      write(nodes_[1], tree_.nodes[0].bounds, {&tree_.nodes[0], 1});
    } else {
      places_[0] = next_number_++;
      write_inner_nodes();
    }
    write_leaves();
  }

 private:
  void write_inner_nodes() {
    std::vector<std::uint32_t> pending = {0};
    while (!pending.empty()) {
      const std::uint32_t i = pending.back();
      pending.pop_back();
      const Tree::Node& node = tree_.nodes[i];
      const auto children = std::span(tree_.nodes).subspan(node.first, node.count);
      Box box;
      for (const Tree::Node& child : children) box.grow(child.bounds);
      write(nodes_[places_[i]], box, children);
      for (std::uint32_t c = node.count; c-- > 0;) {
        if (!children[c].is_leaf()) pending.push_back(node.first + c);
      }
    }
  }

  std::uint32_t number(const Tree::Node& child) {
    const auto index = static_cast<std::size_t>(&child - tree_.nodes.data());
    return places_[index] = next_number_++;
  }

  std::uint32_t place_leaf(const Tree::Node& leaf) {
    const auto index = static_cast<std::size_t>(&leaf - tree_.nodes.data());
    places_[index] = next_word_;
    next_word_ += static_cast<std::uint32_t>(sizes_.words(index));
    return places_[index];
  }

  void write_leaves() {
    out_.leaves = Arena((next_word_ + words_at_once) * sizeof(std::uint32_t));
    auto* words = reinterpret_cast<std::uint32_t*>(out_.leaves.data());
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, tree_.nodes.size(), 1 << 8), [&](const auto& range) {
      for (std::size_t i = range.begin(); i < range.end(); ++i) {
        if (!tree_.nodes[i].is_leaf()) continue;
        const auto names = names_of(tree_, tree_.nodes[i]);
        std::uint32_t* const out = words + places_[i];
        if (sizes_.is_packed(i)) {
          OwnCorners::of(names, mesh_)->pack(out);
        } else {
          std::ranges::copy(names, out);
          out[names.size() - 1] |= last_of_leaf;
        }
      }
    });
  }

  void write_boxes(Node& node, const Box& box, std::span<const Tree::Node> children) {
    std::memset(static_cast<void*>(&node), 0, sizeof node);
    if (children.empty()) return;
    const Grid grid = grid_over(box);
    for (std::size_t axis = 0; axis < 3; ++axis) {
      node.origin[axis] = grid.origin[axis];
      node.exponent[axis] = grid.exponent[axis];
      for (std::size_t c = 0; c < children.size(); ++c) {
        node.planes[2 * axis][c] = round_down(grid, axis, children[c].bounds.lower[axis]);
        node.planes[2 * axis + 1][c] = round_up(grid, axis, children[c].bounds.upper[axis]);
      }
    }
  }

  void write(QuantizedNode16& node, const Box& box, std::span<const Tree::Node> children) {
    write_boxes(node, box, children);
    for (std::size_t c = 0; c < children.size(); ++c) {
      node.children[c] = children[c].is_leaf() ? place_leaf(children[c]) * 2 + 1 : number(children[c]) * 2;
    }
  }

  /// Has leaves name their triangles, the largest first, until the last one is near enough to the first.
  void make_room(std::span<const Tree::Node> children) {
    const auto first = static_cast<std::size_t>(children.data() - tree_.nodes.data());
    while (true) {
      std::size_t before = 0, words = 0, largest = first;
      for (std::size_t i = first; i < first + children.size(); ++i) {
        if (!tree_.nodes[i].is_leaf()) continue;
        before = words;
        words += sizes_.words(i);
        if (sizes_.growth(i) > sizes_.growth(largest)) largest = i;
      }
      if (before < no_child || sizes_.growth(largest) == 0) return;
      sizes_.unpack(largest);
    }
  }

  void write(QuantizedNode8& node, const Box& box, std::span<const Tree::Node> children) {
    write_boxes(node, box, children);
    std::ranges::fill(node.place, static_cast<std::uint8_t>(no_child));
    node.first_node = next_number_;
    node.first_leaf = next_word_;
    make_room(children);
    for (std::size_t c = 0; c < children.size(); ++c) {
      const bool leaf = children[c].is_leaf();
      const std::uint32_t place =
          leaf ? place_leaf(children[c]) - node.first_leaf : number(children[c]) - node.first_node;
      if (place >= no_child) {
        throw UsageError(fmt::format(
            "'compressed(8)' has room for {} triangles before the last leaf of a node, not {}; make smaller "
            "leaves or use compressed(16)",
            no_child - 1, place));
      }
      node.place[c] = static_cast<std::uint8_t>(place);
      if (!leaf) node.inner = static_cast<std::uint8_t>(node.inner | 1u << c);
    }
  }

  const Tree& tree_;
  const Mesh& mesh_;
  QuantizedArena& out_;
  LeafSizes sizes_;
  Node* nodes_;
  std::vector<std::uint32_t> places_;  // numbers of nodes, first words of leaves
  std::uint32_t next_number_ = 1, next_word_ = 1;
};

float reach_of_box(const Box& box) {
  float reach = 0;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    reach = std::max({reach, std::fabs(box.lower[axis]), std::fabs(box.upper[axis])});
  }
  return reach;
}

}  // namespace

bool has_quantized_names(const Tree& tree, const Mesh& mesh) {
  constexpr std::size_t most_words = (std::size_t{1} << 31) - 2 * words_at_once;
  return tree.references.size() < most_words / (bytes_per_triangle / sizeof(std::uint32_t)) &&
         tree.nodes.size() < most_words && mesh.triangles.size() <= packed_leaf;
}

WideView quantized_view(const std::byte* nodes, const std::uint32_t* leaf_words, std::span<const Vec3> positions,
                        std::span<const Triangle> triangles) {
  WideView view;
  view.base = nodes;
  view.root = quantized_root;
  view.leaf_words = leaf_words;
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
QuantizedArena encode_quantized(const Tree& tree, const Mesh& mesh) {
  QuantizedArena out;
  Encoder<Node>(tree, mesh, out).run();
  out.shape.lanes = sizeof(Node::planes[0]);
  if (!tree.empty()) {
    out.shape = {out.nodes.bytes() / sizeof(Node) - (tree.nodes[0].is_leaf() ? 1 : 2), out.nodes.bytes(),
                 sizeof(Node::planes[0]), std::max<std::size_t>(tree.nodes.size() - 1, 1), tree.references.size()};
  }
  out.positions = mesh.positions;
  out.triangles = mesh.triangles;
  out.bounds = tree.empty() ? Box{} : tree.nodes[0].bounds;
  out.view = quantized_view(out.nodes.data(), reinterpret_cast<const std::uint32_t*>(out.leaves.data()), out.positions,
                            out.triangles);
  out.view.reach = tree.empty() ? 0 : reach_of_box(out.bounds);
  out.view.stack = needs_of(tree).stack;
  out.view.out_of_cache = out.bytes() + mesh.positions.size() * sizeof(Vec3) > small_tree_bytes;
  return out;
}

template QuantizedArena encode_quantized<QuantizedNode8>(const Tree&, const Mesh&);
template QuantizedArena encode_quantized<QuantizedNode16>(const Tree&, const Mesh&);

}  // namespace boxwood
