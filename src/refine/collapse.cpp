// Makes trees wider by lifting descendants up to their ancestors. Leaves, their order and their contents never change.
//   area      the usual collapse to k children: the largest inner child is opened first (Wald, Benthin, Boulos 2008)
//   levels    every log2(k) levels become one: what the wide BVH study meant (its section 2.10)
//   squaring  log2(k) - 1 passes that each merge pairs of levels: what that study measured (its section 2.9), so nodes
//   of
//             4, 16 and 256 children under the labels 4, 8 and 16
#include <bit>
#include <vector>

#include "boxwood/error.h"
#include "math/large_memory.h"
#include "refine/stages.h"

namespace boxwood {
namespace {

enum class Method { area, levels, squaring };

struct CollapseOptions {
  std::uint32_t k = 4;
  Method method = Method::area;
};

constexpr std::uint32_t largest_k = 256;
constexpr std::uint32_t largest_squaring_k = 16;

/// Levels of the binary tree that become one; of the methods that merge levels.
std::uint32_t merged_levels(const CollapseOptions& options) {
  const auto log2_k = static_cast<std::uint32_t>(std::countr_zero(options.k));
  return options.method == Method::levels ? log2_k : 1u << (log2_k - 1);
}

std::uint32_t arity(const CollapseOptions& options) {
  if (options.method == Method::area || !std::has_single_bit(options.k) || options.k > largest_k) return options.k;
  return 1u << std::min(merged_levels(options), 26u);
}

/// The children that a node gets, in the order of its leaves. For one node after the other.
class Lifted {
 public:
  explicit Lifted(const Tree& tree) : tree_(tree) {}

  /// Begins with the children that a node has.
  void begin(std::uint32_t node) {
    axis_ = tree_.nodes[node].axis;
    fixed_order_ = tree_.nodes[node].fixed_order;
    nodes_.clear();
    append_children(node);
  }

  const std::vector<std::uint32_t>& nodes() const { return nodes_; }
  /// The axis along which all of them ascend, if they do.
  std::uint32_t axis() const { return axis_; }
  bool fixed_order() const { return fixed_order_; }

  /// Opens the largest inner child that fits, until there are k children.
  void open_by_area(std::uint32_t k) {
    for (;;) {
      std::size_t largest = nodes_.size();
      float largest_area = -1;
      for (std::size_t i = 0; i < nodes_.size(); ++i) {
        const Tree::Node& child = tree_.nodes[nodes_[i]];
        if (child.is_leaf() || nodes_.size() - 1 + child.count > k) continue;
        if (const float area = half_area(child.bounds); area > largest_area) {
          largest = i;
          largest_area = area;
        }
      }
      if (largest == nodes_.size()) return;
      open(largest);
    }
  }

  /// Opens every inner child once.
  void open_level() {
    std::vector<std::uint32_t> opened;
    opened.swap(nodes_);
    for (const std::uint32_t node : opened) {
      if (tree_.nodes[node].is_leaf()) {
        nodes_.push_back(node);
      } else {
        note_opened(tree_.nodes[node]);
        append_children(node);
      }
    }
  }

 private:
  void append_children(std::uint32_t node) {
    const Tree::Node& parent = tree_.nodes[node];
    for (std::uint32_t i = 0; i < parent.count; ++i) nodes_.push_back(parent.first + i);
  }

  void open(std::size_t place) {
    const Tree::Node& opened = tree_.nodes[nodes_[place]];
    note_opened(opened);
    nodes_[place] = opened.first;
    nodes_.insert(nodes_.begin() + static_cast<std::ptrdiff_t>(place) + 1, opened.count - 1, 0);
    for (std::uint32_t i = 1; i < opened.count; ++i) nodes_[place + i] = opened.first + i;
  }

  void note_opened(const Tree::Node& opened) {
    if (opened.axis != axis_) axis_ = Tree::mixed_axis;
    if (!opened.fixed_order) fixed_order_ = false;
  }

  const Tree& tree_;
  std::vector<std::uint32_t> nodes_;
  std::uint32_t axis_ = Tree::mixed_axis;
  bool fixed_order_ = false;
};

/// Throws when the options make no sense, or not for this tree.
void check(const CollapseOptions& options, const Tree& tree) {
  const bool by_area = options.method == Method::area;
  if (!by_area && !std::has_single_bit(options.k)) {
    throw UsageError("collapse with method=levels or squaring takes a power of two as k, not " +
                     std::to_string(options.k));
  }
  if (options.method == Method::squaring && options.k > largest_squaring_k) {
    throw UsageError("collapse with method=squaring takes k up to 16, which already makes nodes of 256 children");
  }
  const std::uint32_t widest = by_area ? options.k : 2;
  for (const Tree::Node& node : tree.nodes) {
    if (node.is_leaf() || node.count <= widest) continue;
    throw UsageError("collapse(k=" + std::to_string(options.k) + ") takes trees of at most " + std::to_string(widest) +
                     " children per node, but the tree has a node with " + std::to_string(node.count) +
                     "; collapse less before it, or build with a smaller k");
  }
}

/// O(n k) time for method area, O(n log k) else; beside the old tree only the new nodes are held, in room for as many
/// as the old ones.
Tree collapse(const CollapseOptions& options, Tree tree) {
  check(options, tree);
  if (tree.empty()) return tree;
  Tree::Nodes nodes;
  nodes.reserve(tree.nodes.size());
  nodes.push_back(tree.nodes[0]);
  struct Pending {
    std::uint32_t from, to;  // a node of the old tree, its place in the new one
  };
  std::vector<Pending> stack{{0, 0}};
  Lifted lifted(tree);
  while (!stack.empty()) {
    const Pending pending = stack.back();
    stack.pop_back();
    if (tree.nodes[pending.from].is_leaf()) continue;
    lifted.begin(pending.from);
    if (options.method == Method::area) {
      lifted.open_by_area(options.k);
    } else {
      for (std::uint32_t level = 1; level < merged_levels(options); ++level) lifted.open_level();
    }
    const auto first = static_cast<std::uint32_t>(nodes.size());
    Tree::Node& node = nodes[pending.to];
    node.first = first;
    node.count = static_cast<std::uint32_t>(lifted.nodes().size()) & Tree::max_count;
    node.axis = lifted.axis() & 3;
    node.fixed_order = lifted.fixed_order();
    for (const std::uint32_t child : lifted.nodes()) nodes.push_back(tree.nodes[child]);
    for (std::size_t i = lifted.nodes().size(); i-- > 0;) {
      stack.push_back({lifted.nodes()[i], first + static_cast<std::uint32_t>(i)});
    }
  }
  tree.nodes = std::move(nodes);
  return tree;
}

}  // namespace

Stage collapse_stage() {
  OptionsOf<CollapseOptions> options;
  options.integer("k", &CollapseOptions::k, 2, largest_k, "children per node")
      .positional()
      .choice("method", &CollapseOptions::method, {"area", "levels", "squaring"},
              "what is lifted: the largest children, log2(k) levels, or log2(k) - 1 times every other level");
  return refinement_stage<CollapseOptions>("collapse", "makes nodes wider by lifting descendants",
                                           "Wald, Benthin, Boulos 2008; wide BVH study", options, collapse, arity);
}

}  // namespace boxwood
