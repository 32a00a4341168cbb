#pragma once
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "tree/tree.h"

namespace boxwood {

/// A tree cut into subtrees, its parts, and what lies above them. Every leaf is in one part.
struct TreeParts {
  struct Part {
    std::uint32_t root = 0;            ///< node
    std::uint32_t begin = 0, end = 0;  ///< its nodes, in `order`
    std::uint32_t references = 0;      ///< below it
  };
  std::vector<std::uint32_t>
      order;                ///< every node, parents before their children: those above the parts, then part by part
  std::uint32_t above = 0;  ///< nodes above the parts
  std::vector<Part> parts;
};

/// Whether a node with so many references, the first of which is `first`, is the root of a part.
using IsPart = std::function<bool(std::uint32_t references, std::uint32_t first)>;

/// Cuts off the first node on every path from the root that `is_part` wants, and leaves in any case. O(nodes).
TreeParts cut_tree(const Tree& tree, const IsPart& is_part);

/// What the surface area model says of one node: its area, times its references where it is a leaf.
double node_cost(const Tree::Node& node);

/// What the surface area model says of a part, or of what lies above all of them, in squared units: inner areas plus
/// leaf areas times their references, with both constants 1.
using PartCosts = std::vector<double>;

/// Fits every box to its contents anew, after primitives moved; `box_of(primitive, box)` grows `box` by a primitive.
/// Costs of the parts, then of what lies above. Boxes of unions are exact, so the result does not depend on threads.
/// Parallel; O(nodes + references).
PartCosts refit(Tree& tree, const TreeParts& parts,
                const std::function<void(std::span<const std::uint32_t> primitives, Box& box)>& grow);

/// The costs alone.
PartCosts part_costs(const Tree& tree, const TreeParts& parts);

}  // namespace boxwood
