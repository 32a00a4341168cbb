#include "refine/reinsert/find_reinsertion.h"

namespace boxwood {

Reinsertion ReinsertionFinder::find(Edge from) {
  Reinsertion best{from, LinkTree::no_edge, 0};
  const Box bounds = tree_.bounds(from);
  const float area = half_area(bounds);
  // Taking the subtree out frees its parent, and lets the nodes above shrink up to where it is put in again.
  const Edge sibling = LinkTree::sibling(from);
  Edge path = tree_.parent(from).up;
  float gain = half_area(tree_.bounds(path));
  Box shrunk = tree_.bounds(sibling);
  search(sibling, gain, bounds, area, best);
  if (best.to == sibling) best = {from, LinkTree::no_edge, 0};
  while (true) {
    const Edge beside = LinkTree::sibling(path);
    search(beside, gain, bounds, area, best);
    shrunk.grow(tree_.bounds(beside));
    path = tree_.parent(path).up;
    if (path == LinkTree::no_edge) return best;
    // Beside an ancestor: the new parent is as large as the ancestor was.
    const float shrunk_area = half_area(shrunk);
    if (gain - shrunk_area > best.gain) best = {from, path, gain - shrunk_area};
    gain += half_area(tree_.bounds(path)) - shrunk_area;
  }
}

void ReinsertionFinder::search(Edge subtree, float gain, const Box& bounds, float area, Reinsertion& best) {
  stack_.clear();
  stack_.push_back({subtree, gain});
  while (!stack_.empty()) {
    const Candidate at = stack_.back();
    stack_.pop_back();
    // A new parent here or further down is never smaller than the subtree itself.
    if (at.gain - area <= best.gain) continue;
    const Box& box = tree_.bounds(at.edge);
    const float left = at.gain - half_area(unite(box, bounds));
    if (left > best.gain) best = {best.from, at.edge, left};
    const Child child = tree_.child(at.edge);
    if (child.is_leaf()) continue;
    const float below = left + half_area(box);
    if (below - area <= best.gain) continue;
    stack_.push_back({child.number() * 2, below});
    stack_.push_back({child.number() * 2 + 1, below});
  }
}

}  // namespace boxwood
