#pragma once
#include <vector>

#include "refine/reinsert/find_reinsertion.h"
#include "refine/reinsert/link_tree.h"

namespace boxwood {

/// Moves subtrees one after the other, each only when the tree gets better by it.
class ReinsertionApplier {
 public:
  explicit ReinsertionApplier(LinkTree& tree) : tree_(tree), touched_(tree.inner.size(), 0) {}

  /// Begins a batch: its moves were found in the tree as it is now.
  void begin_batch() { ++batch_; }
  /// Moves what hangs at move.from to beside what hangs at move.to. Nothing happens, and false is returned, when an
  /// earlier move of the batch changed the links around either, or put one below the other, or when the inner nodes'
  /// area would not decrease. O(depth).
  bool apply(const Reinsertion& move);

 private:
  struct Change {
    Edge edge;  ///< no_edge: the root's box
    Box bounds;
    Child child;
  };
  bool still_valid(const Reinsertion& move) const;
  void set(Edge edge, const Box& bounds, Child child);
  double refit(std::uint32_t inner);
  void undo();

  LinkTree& tree_;
  std::vector<std::uint32_t> touched_;  ///< the last batch that changed the links of an inner node
  std::uint32_t batch_ = 0;
  std::vector<Change> changes_;
};

}  // namespace boxwood
