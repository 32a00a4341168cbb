#pragma once
#include <vector>

#include "refine/reinsert/link_tree.h"

namespace boxwood {

/// A subtree at edge `from` that would better hang beside what is at edge `to`.
struct Reinsertion {
  Edge from = LinkTree::no_edge, to = LinkTree::no_edge;
  float gain = 0;  ///< half area that all inner nodes together lose
};

/// Finds where to reinsert subtrees. One per thread.
class ReinsertionFinder {
 public:
  explicit ReinsertionFinder(const LinkTree& tree) : tree_(tree) {}

  /// The best place for what hangs at `from`, which must not be a child of the root; gain 0 when it already hangs
  /// there. Branch and bound over the whole tree, nearest subtrees first (Meister and Bittner 2018, section 3.1).
  Reinsertion find(Edge from);

 private:
  struct Candidate {
    Edge edge;
    float gain;  ///< when the subtree hung below this edge at no further cost
  };
  void search(Edge subtree, float gain, const Box& bounds, float area, Reinsertion& best);

  const LinkTree& tree_;
  std::vector<Candidate> stack_;
};

}  // namespace boxwood
