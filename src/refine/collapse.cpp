// Makes trees wider by lifting descendants up to their ancestors. Leaves, their order and their contents never change.
//   area      the usual collapse to k children: the largest inner child is opened first (Wald, Benthin, Boulos 2008)
//   levels    every log2(k) levels become one: what the wide BVH study meant (its section 2.10)
//   squaring  log2(k) - 1 passes that each merge pairs of levels: what that study measured (its section 2.9), so nodes
//   of
//             4, 16 and 256 children under the labels 4, 8 and 16
#include <bit>
#include <vector>

#include "boxwood/error.h"
#include "refine/stages.h"
#include "tree/assemble.h"

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

/// Writes one node of the wide tree. One per thread.
class Lifter {
 public:
  Lifter(const Tree& tree, const CollapseOptions& options) : tree_(tree), options_(options) {}

  void operator()(std::uint32_t number, Tree::Node& node, std::vector<std::uint32_t>& children,
                  std::vector<std::uint32_t>& references) {
    node = tree_.nodes[number];
    if (node.is_leaf()) {
      const auto first = tree_.references.begin() + node.first;
      node.first = static_cast<std::uint32_t>(references.size());
      references.insert(references.end(), first, first + node.count);
      return;
    }
    append_children(node, children);
    if (options_.method == Method::area) {
      open_by_area(node, children);
    } else {
      for (std::uint32_t level = 1; level < merged_levels(options_); ++level) open_level(node, children);
    }
  }

 private:
  /// Opens the largest inner child that fits, until there are k children.
  void open_by_area(Tree::Node& node, std::vector<std::uint32_t>& children) {
    areas_.clear();
    for (const std::uint32_t child : children) areas_.push_back(area_of(child));
    for (;;) {
      std::size_t largest = children.size();
      float largest_area = -1;
      for (std::size_t i = 0; i < children.size(); ++i) {
        if (areas_[i] <= largest_area || children.size() - 1 + tree_.nodes[children[i]].count > options_.k) continue;
        largest = i;
        largest_area = areas_[i];
      }
      if (largest == children.size()) return;
      const Tree::Node& opened = tree_.nodes[children[largest]];
      note_opened(opened, node);
      const auto place = static_cast<std::ptrdiff_t>(largest);
      children.insert(children.begin() + place, opened.count - 1, 0);
      areas_.insert(areas_.begin() + place, opened.count - 1, 0);
      for (std::uint32_t i = 0; i < opened.count; ++i) {
        children[largest + i] = opened.first + i;
        areas_[largest + i] = area_of(opened.first + i);
      }
    }
  }

  /// Opens every inner child once.
  void open_level(Tree::Node& node, std::vector<std::uint32_t>& children) {
    unopened_.swap(children);
    children.clear();
    for (const std::uint32_t child : unopened_) {
      if (tree_.nodes[child].is_leaf()) {
        children.push_back(child);
      } else {
        note_opened(tree_.nodes[child], node);
        append_children(tree_.nodes[child], children);
      }
    }
  }

  /// Of an inner node; -1, less than any, of a leaf.
  float area_of(std::uint32_t child) const {
    const Tree::Node& node = tree_.nodes[child];
    return node.is_leaf() ? -1 : half_area(node.bounds);
  }

  static void append_children(const Tree::Node& parent, std::vector<std::uint32_t>& children) {
    for (std::uint32_t i = 0; i < parent.count; ++i) children.push_back(parent.first + i);
  }

  /// All children ascend along an axis, and are to be visited as stored, only if those of every opened node do.
  static void note_opened(const Tree::Node& opened, Tree::Node& node) {
    if (opened.axis != node.axis) node.axis = Tree::mixed_axis;
    if (!opened.fixed_order) node.fixed_order = 0;
  }

  const Tree& tree_;
  CollapseOptions options_;
  std::vector<float> areas_;
  std::vector<std::uint32_t> unopened_;
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

/// O(n k) time for method area, O(n log k) else; parallel. The old tree and the new one are held side by side.
Tree collapse(const CollapseOptions& options, Tree tree) {
  check(options, tree);
  if (tree.empty()) return tree;
  Tree out =
      assemble(std::uint32_t{0}, tree.nodes.size(), tree.references.size(), [&] { return Lifter(tree, options); });
  out.clipped_leaves = tree.clipped_leaves;
  return out;
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
