#pragma once
#include <unordered_map>

#include "build/exhaustive/small_set.h"

namespace boxwood {

/// Which partitions of a node's items are considered: cuts between items in order along an axis, or all.
enum class Partitions { sorted, all };

/// The cheapest of all trees over a small set, by remembering the best subtree of every subset met. A tree's cost is a
/// sum over its nodes, so the best subtree does not depend on the rest of the tree; and with sorted cuts a subset is an
/// interval of ranks on each axis, so there are at most (n^2 / 2)^3 of them, far fewer in practice. All partitions: 3^n
/// steps at worst. SAH alternatives study, section 2.14 (the exact oracle).
class BestTree {
 public:
  BestTree(const SmallSet& set, Partitions partitions) : set_(set), partitions_(partitions) {}

  /// Of the best tree over the subset.
  double cost(Subset subset) { return solve(subset).cost; }
  /// The left side of its root; 0 when it is a leaf.
  Subset left(Subset subset) { return solve(subset).left; }
  std::size_t subsets_met() const { return best_.size(); }

 private:
  struct Best {
    double cost = 0;
    Subset left = 0;
  };
  const Best& solve(Subset subset);
  void try_sorted(Subset subset, double visit, Best& best);
  void try_all(Subset subset, double visit, Best& best);

  const SmallSet& set_;
  Partitions partitions_;
  std::unordered_map<Subset, Best> best_;
};

/// The same optimum over sorted cuts by looking at every tree, as the study did. For a dozen items at most.
struct Enumeration {
  double cost = 0;
  std::uint64_t trees = 0;  ///< whole trees looked at
};
/// `bound`: what cannot become cheaper than the cheapest so far, `known` at first, is left out; needs strictly more
/// than it, so that the optimum survives.
Enumeration enumerate_trees(const SmallSet& set, bool bound, double known);

}  // namespace boxwood
