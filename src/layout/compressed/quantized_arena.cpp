#include "layout/compressed/quantized_arena.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstring>

#include "boxwood/error.h"
#include "layout/compressed/quantize.h"
#include "layout/simd/tree_pieces.h"

namespace boxwood {
namespace {

constexpr std::size_t small_tree_bytes = std::size_t{4} << 20;

/// Numbers inner nodes so that siblings are adjacent, and lists primitives so that sibling leaves are.
template <class Node>
class Encoder {
 public:
  Encoder(const Tree& tree, QuantizedArena& out) : tree_(tree), out_(out), numbers_(tree.nodes.size()) {
    const auto inner = static_cast<std::size_t>(
        std::ranges::count_if(tree.nodes, [](const Tree::Node& node) { return !node.is_leaf(); }));
    out_.nodes = Arena((inner + 2) * sizeof(Node));  // none at 0, and a root even of one leaf or nothing
    nodes_ = reinterpret_cast<Node*>(out_.nodes.data());
    out_.primitives.reserve(tree.references.size() + 1 + names_at_once);
    out_.primitives.push_back(0);
  }

  void run() {
    if (tree_.empty()) {
      write(nodes_[1], {}, {});
    } else if (tree_.nodes[0].is_leaf()) {
      write(nodes_[1], tree_.nodes[0].bounds, {&tree_.nodes[0], 1});
    } else {
      numbers_[0] = next_number_++;
      write_inner_nodes();
    }
    out_.primitives.insert(out_.primitives.end(), names_at_once, 0);
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
      write(nodes_[numbers_[i]], box, children);
      for (std::uint32_t c = node.count; c-- > 0;) {
        if (!children[c].is_leaf()) pending.push_back(node.first + c);
      }
    }
  }

  std::uint32_t number(const Tree::Node& child) {
    const auto index = static_cast<std::size_t>(&child - tree_.nodes.data());
    return numbers_[index] = next_number_++;
  }

  std::uint32_t append_leaf(const Tree::Node& leaf) {
    const auto place = static_cast<std::uint32_t>(out_.primitives.size());
    const auto begin = tree_.references.begin() + leaf.first;
    out_.primitives.insert(out_.primitives.end(), begin, begin + leaf.count);
    out_.primitives.back() |= last_of_leaf;
    return place;
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
      node.children[c] = children[c].is_leaf() ? append_leaf(children[c]) * 2 + 1 : number(children[c]) * 2;
    }
  }

  void write(QuantizedNode8& node, const Box& box, std::span<const Tree::Node> children) {
    write_boxes(node, box, children);
    std::ranges::fill(node.place, static_cast<std::uint8_t>(no_child));
    node.first_node = next_number_;
    node.first_primitive = static_cast<std::uint32_t>(out_.primitives.size());
    for (std::size_t c = 0; c < children.size(); ++c) {
      const bool leaf = children[c].is_leaf();
      const std::uint32_t place =
          leaf ? append_leaf(children[c]) - node.first_primitive : number(children[c]) - node.first_node;
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
  QuantizedArena& out_;
  Node* nodes_;
  std::vector<std::uint32_t> numbers_;
  std::uint32_t next_number_ = 1;
};

float reach_of_box(const Box& box) {
  float reach = 0;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    reach = std::max({reach, std::fabs(box.lower[axis]), std::fabs(box.upper[axis])});
  }
  return reach;
}

}  // namespace

bool has_quantized_names(const Tree& tree) {
  constexpr std::size_t most = (std::size_t{1} << 31) - 2 * names_at_once;
  return tree.references.size() < most && tree.nodes.size() < most;
}

WideView quantized_view(const std::byte* nodes, const std::uint32_t* primitives, std::span<const Vec3> positions,
                        std::span<const Triangle> triangles) {
  WideView view;
  view.base = nodes;
  view.root = quantized_root;
  view.primitives = primitives;
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
  Encoder<Node>(tree, out).run();
  out.shape.lanes = sizeof(Node::planes[0]);
  if (!tree.empty()) {
    out.shape = {out.nodes.bytes() / sizeof(Node) - (tree.nodes[0].is_leaf() ? 1 : 2), out.nodes.bytes(),
                 sizeof(Node::planes[0]), std::max<std::size_t>(tree.nodes.size() - 1, 1), tree.references.size()};
  }
  out.positions = mesh.positions;
  out.triangles = mesh.triangles;
  out.bounds = tree.empty() ? Box{} : tree.nodes[0].bounds;
  out.view = quantized_view(out.nodes.data(), out.primitives.data(), out.positions, out.triangles);
  out.view.reach = tree.empty() ? 0 : reach_of_box(out.bounds);
  out.view.stack = needs_of(tree).stack;
  out.view.out_of_cache = out.bytes() + mesh.positions.size() * sizeof(Vec3) > small_tree_bytes;
  return out;
}

template QuantizedArena encode_quantized<QuantizedNode8>(const Tree&, const Mesh&);
template QuantizedArena encode_quantized<QuantizedNode16>(const Tree&, const Mesh&);

}  // namespace boxwood
