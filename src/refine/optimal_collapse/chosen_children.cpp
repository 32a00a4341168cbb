#include "refine/optimal_collapse/chosen_children.h"

#include <algorithm>

namespace boxwood {

std::uint32_t ChildChooser::choose(std::uint32_t node, std::vector<CollapsedNode>& children) {
  chosen_.clear();
  choose_below(node, options_.k);
  if (options_.pack) {
    while (join_leaves()) {
    }
    while (chosen_.size() < options_.k && open_node()) {
      while (join_leaves()) {
      }
    }
  }
  Box centers;
  for (const Candidate& child : chosen_) centers.grow(child.bounds.center());
  const auto axis = static_cast<std::size_t>(longest_axis(centers.extent()));
  std::stable_sort(chosen_.begin(), chosen_.end(), [axis](const Candidate& a, const Candidate& b) {
    return a.bounds.center()[axis] < b.bounds.center()[axis];
  });
  for (const Candidate& child : chosen_) children.push_back(child.item);
  return static_cast<std::uint32_t>(axis);
}

/// What hangs side by side when a subtree is written as at most `count` nodes. Recursion is less than k deep.
void ChildChooser::choose_least(std::uint32_t node, std::uint32_t count) {
  while (count > 1 && costs_.cost(node, count - 1) <= costs_.cost(node, count)) --count;
  if (count == 1 || tree_.nodes[node].is_leaf()) {
    append(node);
  } else {
    choose_below(node, count);
  }
}

void ChildChooser::choose_below(std::uint32_t node, std::uint32_t count) {
  const std::uint32_t first = costs_.share_of_first(node, count);
  choose_least(tree_.nodes[node].first, first);
  choose_least(tree_.nodes[node].first + 1, count - first);
}

void ChildChooser::append(std::uint32_t node) {
  const std::uint32_t references = costs_.is_leaf(node) ? costs_.references(node) : 0;
  chosen_.push_back({{node}, tree_.nodes[node].bounds, references});
}

/// Makes one leaf of the two that gain most by it, if any do not lose. One is always left beside it: a node has two
/// children at least.
bool ChildChooser::join_leaves() {
  if (chosen_.size() <= 2) return false;
  const auto cost = [&](const Box& bounds, std::uint32_t references) {
    return half_area(bounds) * static_cast<float>(options_.blocks(references));
  };
  float best_gain = 0;
  std::size_t first = 0, second = 0;
  for (std::size_t j = 1; j < chosen_.size(); ++j) {
    const Candidate& b = chosen_[j];
    if (b.references == 0 || b.item.joined != CollapsedNode::nothing) continue;
    for (std::size_t i = 0; i < j; ++i) {
      const Candidate& a = chosen_[i];
      if (a.references == 0 || a.item.joined != CollapsedNode::nothing) continue;
      if (a.references + b.references > options_.leaf) continue;
      const float gain = cost(a.bounds, a.references) + cost(b.bounds, b.references) -
                         cost(unite(a.bounds, b.bounds), a.references + b.references);
      if (gain < best_gain || (gain == best_gain && second != 0)) continue;
      best_gain = gain;
      first = i;
      second = j;
    }
  }
  if (second == 0) return false;
  Candidate& into = chosen_[first];
  into.item.joined = chosen_[second].item.node;
  into.bounds.grow(chosen_[second].bounds);
  into.references += chosen_[second].references;
  chosen_.erase(chosen_.begin() + static_cast<std::ptrdiff_t>(second));
  return true;
}

/// Replaces the inner node that gains most by it by its two children, if one gains.
bool ChildChooser::open_node() {
  float best_gain = 0;
  std::size_t best = chosen_.size();
  for (std::size_t i = 0; i < chosen_.size(); ++i) {
    if (chosen_[i].references > 0) continue;
    const std::uint32_t node = chosen_[i].item.node, first = tree_.nodes[node].first;
    const float gain = costs_.cost(node, 1) - costs_.cost(first, 1) - costs_.cost(first + 1, 1);
    if (gain <= best_gain) continue;
    best_gain = gain;
    best = i;
  }
  if (best == chosen_.size()) return false;
  const std::uint32_t first = tree_.nodes[chosen_[best].item.node].first;
  chosen_.erase(chosen_.begin() + static_cast<std::ptrdiff_t>(best));
  append(first);
  append(first + 1);
  return true;
}

}  // namespace boxwood
