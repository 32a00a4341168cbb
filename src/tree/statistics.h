#pragma once
#include <cstddef>
#include <cstdint>
#include <vector>

#include "tree/tree.h"

namespace boxwood {

/// Costs of the surface area model, in any common unit.
struct SahConstants {
  double traversal = 1;     ///< visiting one inner node, whatever its arity
  double intersection = 1;  ///< testing one primitive
};

/// In squared units, in double; 0 for an empty box.
double box_area(const Box& box);

/// (C_traversal * sum of inner areas + C_intersection * sum of leaf areas times their counts) / root area. In double,
/// in node order. 0 for an empty tree; the count of a tree whose root has no area is taken with every probability 1.
double sah_cost(const Tree& tree, const SahConstants& constants = {});

/// Area of the pairwise intersections of siblings, over the area of their parents, all depths together; 0 is no
/// overlap. Beyond 256 children only those less than 256 places apart are paired.
double sibling_overlap(const Tree& tree);

struct TreeStatistics {
  std::uint64_t inner_nodes = 0, leaves = 0, references = 0;
  std::uint32_t max_depth = 0;  ///< edges from the root to the deepest leaf
  double mean_leaf_depth = 0;
  std::uint32_t max_arity = 0;
  double mean_arity = 0;
  std::vector<std::uint64_t>
      leaf_sizes;                      ///< [s] = leaves that hold s references; the last entry counts longer ones too
  std::vector<std::uint64_t> arities;  ///< [a] = inner nodes with a children; likewise
  SahConstants constants;
  double sah_cost = 0;
  /// [d] = area of pairwise intersections of siblings at depth d+1, over the area of their parents; 0 is no overlap.
  /// Beyond 256 children only those less than 256 places apart are paired.
  std::vector<double> sibling_overlap;
  std::size_t bytes = 0;
};

TreeStatistics statistics(const Tree& tree, const SahConstants& constants = {});

}  // namespace boxwood
