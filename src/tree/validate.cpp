#include "tree/validate.h"

#include <fmt/format.h>

#include <algorithm>
#include <vector>

namespace boxwood {
namespace {

/// Checks one invariant after the other; each method returns the first violation, or an empty string.
class Validator {
 public:
  Validator(const Tree& tree, std::span<const Box> bounds, std::uint32_t max_arity)
      : tree_(tree), nodes_(tree.nodes), bounds_(bounds), max_arity_(max_arity) {}

  std::string run() const {
    if (nodes_.empty()) {
      if (!tree_.references.empty())
        return fmt::format("there are {} references but no nodes", tree_.references.size());
      return primitives();
    }
    for (const auto check :
         {&Validator::shape, &Validator::reachability, &Validator::leaf_spans, &Validator::primitives,
          &Validator::containment, &Validator::coverage, &Validator::cells}) {
      if (std::string violation = (this->*check)(); !violation.empty()) return violation;
    }
    return {};
  }

 private:
  /// Counts and indices of every node.
  std::string shape() const {
    for (std::size_t i = 0; i < nodes_.size(); ++i) {
      const Tree::Node& node = nodes_[i];
      const std::size_t end = std::size_t{node.first} + node.count;
      if (node.is_leaf()) {
        if (node.count == 0) return fmt::format("leaf {} holds no references", i);
        if (end > tree_.references.size()) {
          return fmt::format("leaf {} holds references {} to {} of {}", i, node.first, end - 1,
                             tree_.references.size());
        }
        continue;
      }
      if (node.count < 2)
        return fmt::format("inner node {} has {} children, fewer than 2", i, std::uint32_t{node.count});
      if (max_arity_ && node.count > max_arity_) {
        return fmt::format("inner node {} has {} children, more than {}", i, std::uint32_t{node.count}, max_arity_);
      }
      if (end > nodes_.size()) {
        return fmt::format("inner node {} has children {} to {} of {} nodes", i, node.first, end - 1, nodes_.size());
      }
      if (node.first <= i) return fmt::format("inner node {} has child {}, which is not after it", i, node.first);
    }
    return {};
  }

  /// One parent for each node but the root. With children after parents, that also rules out cycles.
  std::string reachability() const {
    std::vector<bool> has_parent(nodes_.size());
    for (std::size_t i = 0; i < nodes_.size(); ++i) {
      if (nodes_[i].is_leaf()) continue;
      for (std::size_t child = nodes_[i].first; child < std::size_t{nodes_[i].first} + nodes_[i].count; ++child) {
        if (has_parent[child]) return fmt::format("node {} has two parents, the second is node {}", child, i);
        has_parent[child] = true;
      }
    }
    for (std::size_t i = 1; i < nodes_.size(); ++i) {
      if (!has_parent[i]) return fmt::format("node {} can not be reached from the root", i);
    }
    return {};
  }

  std::string leaf_spans() const {
    std::vector<bool> in_leaf(tree_.references.size());
    for (std::size_t i = 0; i < nodes_.size(); ++i) {
      if (!nodes_[i].is_leaf()) continue;
      for (std::size_t r = nodes_[i].first; r < std::size_t{nodes_[i].first} + nodes_[i].count; ++r) {
        if (in_leaf[r]) return fmt::format("reference {} lies in two leaves, the second is node {}", r, i);
        in_leaf[r] = true;
      }
    }
    const auto lost = std::find(in_leaf.begin(), in_leaf.end(), false);
    if (lost != in_leaf.end()) return fmt::format("reference {} lies in no leaf", lost - in_leaf.begin());
    return {};
  }

  std::string primitives() const {
    std::vector<bool> referenced(bounds_.size());
    for (std::size_t r = 0; r < tree_.references.size(); ++r) {
      const std::uint32_t primitive = tree_.references[r];
      if (primitive >= bounds_.size()) {
        return fmt::format("reference {} is primitive {} of {}", r, primitive, bounds_.size());
      }
      if (bounds_[primitive].empty())
        return fmt::format("reference {} is primitive {}, which has no box", r, primitive);
      if (referenced[primitive] && !tree_.clipped_leaves) {
        return fmt::format("primitive {} is referenced twice, again by reference {}", primitive, r);
      }
      referenced[primitive] = true;
    }
    for (std::size_t primitive = 0; primitive < bounds_.size(); ++primitive) {
      if (!referenced[primitive] && !bounds_[primitive].empty()) {
        return fmt::format("primitive {} is not referenced", primitive);
      }
    }
    return {};
  }

  std::string containment() const {
    if (nodes_[0].bounds.empty()) return "the root's box is empty";
    for (std::size_t i = 0; i < nodes_.size(); ++i) {
      if (nodes_[i].is_leaf()) continue;
      for (std::size_t child = nodes_[i].first; child < std::size_t{nodes_[i].first} + nodes_[i].count; ++child) {
        if (nodes_[child].bounds.empty()) return fmt::format("the box of node {} is empty", child);
        if (!nodes_[i].bounds.contains(nodes_[child].bounds)) {
          return fmt::format("the box of node {} is not inside that of its parent, node {}", child, i);
        }
      }
    }
    return {};
  }

  std::string coverage() const { return tree_.clipped_leaves ? coverage_by_parts() : coverage_by_leaves(); }

  std::string coverage_by_leaves() const {
    for (std::size_t i = 0; i < nodes_.size(); ++i) {
      if (!nodes_[i].is_leaf()) continue;
      for (std::uint32_t r = nodes_[i].first; r < nodes_[i].first + nodes_[i].count; ++r) {
        const std::uint32_t primitive = tree_.references[r];
        if (!nodes_[i].bounds.contains(bounds_[primitive])) {
          return fmt::format("the box of leaf {} does not hold that of primitive {}", i, primitive);
        }
      }
    }
    return {};
  }

  /// What boxes alone can tell of clipped leaves: each touches its primitives.
  std::string coverage_by_parts() const {
    for (std::size_t i = 0; i < nodes_.size(); ++i) {
      if (!nodes_[i].is_leaf()) continue;
      for (std::uint32_t r = nodes_[i].first; r < nodes_[i].first + nodes_[i].count; ++r) {
        const std::uint32_t primitive = tree_.references[r];
        if (intersect(nodes_[i].bounds, bounds_[primitive]).empty()) {
          return fmt::format("the box of leaf {} does not touch that of primitive {}", i, primitive);
        }
      }
    }
    return {};
  }

  std::string cells() const {
    const std::vector<OctreeCode>& codes = tree_.cells.codes;
    if (codes.empty()) return {};
    if (codes.size() != nodes_.size())
      return fmt::format("there are {} cells for {} nodes", codes.size(), nodes_.size());
    for (std::size_t i = 0; i < nodes_.size(); ++i) {
      if (codes[i] == 0) return fmt::format("node {} has no cell", i);
      if (!octree_cell(codes[i]).box(tree_.cells.grid).contains(nodes_[i].bounds)) {
        return fmt::format("the box of node {} is not inside its cell", i);
      }
      std::uint32_t octants = 0;
      for (std::size_t c = nodes_[i].first; !nodes_[i].is_leaf() && c < std::size_t{nodes_[i].first} + nodes_[i].count;
           ++c) {
        const std::uint32_t level = octree_level(codes[i]), below = octree_level(codes[c]);
        if (below <= level || codes[c] >> 3 * (below - level) != codes[i]) {
          return fmt::format("the cell of node {} is not inside that of its parent, node {}", c, i);
        }
        const std::uint32_t octant = 1u << octree_octant(codes[c], level + 1);
        if (octants & octant) return fmt::format("two children of node {} lie in the same octant", i);
        octants |= octant;
      }
    }
    return {};
  }

  const Tree& tree_;
  const Tree::Nodes& nodes_;
  std::span<const Box> bounds_;
  std::uint32_t max_arity_;
};

}  // namespace

std::string validate(const Tree& tree, std::span<const Box> bounds, std::uint32_t max_arity) {
  return Validator(tree, bounds, max_arity).run();
}

}  // namespace boxwood
