#include "refine/reinsert/apply_reinsertion.h"

namespace boxwood {
namespace {

/// In double, so that a sum over the tree decreases when a move says so.
double exact_half_area(const Box& box) {
  const double x = double{box.upper.x} - double{box.lower.x};
  const double y = double{box.upper.y} - double{box.lower.y};
  const double z = double{box.upper.z} - double{box.lower.z};
  return x * y + y * z + z * x;
}

/// Of a change in area relative to the areas involved: less than this could be rounding.
constexpr double least_gain = 1e-9;

}  // namespace

bool ReinsertionApplier::still_valid(const Reinsertion& move) const {
  const std::uint32_t parent = move.from >> 1;
  const std::uint32_t grandparent = tree_.inner[parent].up >> 1;
  if (touched_[parent] == batch_ || touched_[grandparent] == batch_ || touched_[move.to >> 1] == batch_) return false;
  for (Edge edge = move.to; edge != LinkTree::no_edge; edge = tree_.parent(edge).up) {
    if (edge == move.from) return false;
  }
  return true;
}

void ReinsertionApplier::set(Edge edge, const Box& bounds, Child child) {
  LinkTree::Inner& parent = tree_.parent(edge);
  changes_.push_back({edge, parent.bounds[edge & 1], parent.children[edge & 1]});
  parent.bounds[edge & 1] = bounds;
  parent.children[edge & 1] = child;
  if (!child.is_leaf()) tree_.inner[child.number()].up = edge;
}

/// Fits the boxes from `inner` up. Returns how much area they gain.
double ReinsertionApplier::refit(std::uint32_t inner) {
  double gained = 0;
  while (true) {
    const Box bounds = unite(tree_.inner[inner].bounds[0], tree_.inner[inner].bounds[1]);
    const Edge edge = tree_.inner[inner].up;
    const Box before = edge == LinkTree::no_edge ? tree_.root_bounds : tree_.bounds(edge);
    if (bounds == before) return gained;
    gained += exact_half_area(bounds) - exact_half_area(before);
    if (edge == LinkTree::no_edge) {
      changes_.push_back({edge, before, {}});
      tree_.root_bounds = bounds;
      return gained;
    }
    set(edge, bounds, tree_.child(edge));
    inner = edge >> 1;
  }
}

void ReinsertionApplier::undo() {
  while (!changes_.empty()) {
    const Change change = changes_.back();
    changes_.pop_back();
    if (change.edge == LinkTree::no_edge) {
      tree_.root_bounds = change.bounds;
      continue;
    }
    LinkTree::Inner& parent = tree_.parent(change.edge);
    parent.bounds[change.edge & 1] = change.bounds;
    parent.children[change.edge & 1] = change.child;
    if (!change.child.is_leaf()) tree_.inner[change.child.number()].up = change.edge;
  }
}

bool ReinsertionApplier::apply(const Reinsertion& move) {
  if (!still_valid(move)) return false;
  changes_.clear();
  const std::uint32_t parent = move.from >> 1;
  const Edge above = tree_.inner[parent].up, sibling = LinkTree::sibling(move.from);
  const Box moved = tree_.bounds(move.from);
  const Child subtree = tree_.child(move.from);
  // Take it out: its sibling moves up into the parent's place.
  const double freed = exact_half_area(tree_.bounds(above));
  set(above, tree_.bounds(sibling), tree_.child(sibling));
  double gained = -freed + refit(above >> 1);
  // Put it in: the parent, now free, takes the place of the target and holds both. The sibling as a target has moved.
  const Edge to = move.to == sibling ? above : move.to;
  const Box target = tree_.bounds(to), joined = unite(target, moved);
  const Child beside = tree_.child(to);
  set(parent * 2, target, beside);
  set(parent * 2 + 1, moved, subtree);
  set(to, joined, {parent});
  gained += exact_half_area(joined) + refit(to >> 1);
  if (gained >= -least_gain * freed) {
    undo();
    return false;
  }
  for (const std::uint32_t inner : {parent, above >> 1, to >> 1}) touched_[inner] = batch_;
  return true;
}

}  // namespace boxwood
