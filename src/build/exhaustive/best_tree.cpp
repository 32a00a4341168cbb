#include "build/exhaustive/best_tree.h"

#include <algorithm>
#include <limits>

namespace boxwood {

const BestTree::Best& BestTree::solve(Subset subset) {
  if (const auto found = best_.find(subset); found != best_.end()) return found->second;
  Best best{set_.leaf_cost(subset), 0};
  if (!set_.must_be_leaf(subset)) {
    if (!set_.may_be_leaf(subset)) best.cost = std::numeric_limits<double>::infinity();
    const double visit = set_.costs().traversal * set_.area_of(subset);
    if (partitions_ == Partitions::sorted) {
      try_sorted(subset, visit, best);
    } else {
      try_all(subset, visit, best);
    }
  }
  return best_.emplace(subset, best).first->second;
}

void BestTree::try_sorted(Subset subset, double visit, Best& best) {
  std::vector<SmallSet::Cut> cuts = set_.cuts(subset);
  // The most promising first, so that the others need not be tried.
  std::ranges::stable_sort(cuts, {}, &SmallSet::Cut::least);
  for (const SmallSet::Cut& cut : cuts) {
    if (visit + cut.least >= best.cost) break;
    const double cost = visit + solve(cut.left).cost + solve(cut.right).cost;
    if (cost < best.cost) best = {cost, cut.left};
  }
}

void BestTree::try_all(Subset subset, double visit, Best& best) {
  const Subset lowest = subset & ~(subset - 1), others = subset & ~lowest;
  // Every part that holds the lowest item, but the whole.
  for (Subset part = (others - 1) & others;; part = (part - 1) & others) {
    const Subset left = part | lowest, right = subset & ~left;
    if (visit + set_.least_cost(left) + set_.least_cost(right) < best.cost) {
      const double cost = visit + solve(left).cost + solve(right).cost;
      if (cost < best.cost) best = {cost, left};
    }
    if (part == 0) break;
  }
}

namespace {

/// Decides one node after the other, in every way there is.
class Enumerator {
 public:
  Enumerator(const SmallSet& set, bool bound, double known) : set_(set), bound_(bound) {
    result_.cost = bound ? known : std::numeric_limits<double>::infinity();
  }

  Enumeration run() {
    undecided_.push_back(set_.all());
    least_of_undecided_ = set_.least_cost(set_.all());
    decide(0);
    return result_;
  }

 private:
  /// `spent`: what the nodes decided so far cost.
  void decide(double spent) {
    if (bound_ && spent + least_of_undecided_ > result_.cost * (1 + 1e-12)) return;
    if (undecided_.empty()) {
      ++result_.trees;
      result_.cost = std::min(result_.cost, spent);
      return;
    }
    const Subset subset = undecided_.back();
    const double least = set_.least_cost(subset), outer = least_of_undecided_;
    undecided_.pop_back();
    least_of_undecided_ = outer - least;
    if (set_.may_be_leaf(subset)) decide(spent + set_.leaf_cost(subset));
    if (!set_.must_be_leaf(subset)) {
      const double visit = set_.costs().traversal * set_.area_of(subset);
      for (const SmallSet::Cut& cut : set_.cuts(subset)) {
        undecided_.push_back(cut.right);
        undecided_.push_back(cut.left);
        least_of_undecided_ = outer - least + cut.least;
        decide(spent + visit);
        undecided_.resize(undecided_.size() - 2);
      }
    }
    undecided_.push_back(subset);
    least_of_undecided_ = outer;
  }

  const SmallSet& set_;
  bool bound_;
  Enumeration result_;
  std::vector<Subset> undecided_;
  double least_of_undecided_ = 0;
};

}  // namespace

Enumeration enumerate_trees(const SmallSet& set, bool bound, double known) {
  if (set.size() == 0) return {};
  return Enumerator(set, bound, known).run();
}

}  // namespace boxwood
