#include "tree/reference_slots.h"

#include <algorithm>

namespace boxwood {

ReferenceSlots::ReferenceSlots(const Tree& tree) : begin_(tree.nodes.size()), end_(tree.nodes.size()) {
  if (tree.empty()) return;
  std::uint32_t next = 0;
  std::vector<std::uint32_t> stack{0}, walk;
  while (!stack.empty()) {
    const std::uint32_t number = stack.back();
    stack.pop_back();
    walk.push_back(number);
    const Tree::Node& node = tree.nodes[number];
    begin_[number] = next;
    if (node.is_leaf()) {
      for (std::uint32_t i = 0; i < node.count; ++i) by_primitive_.push_back({tree.references[node.first + i], next++});
    } else {
      for (std::uint32_t i = node.count; i-- > 0;) stack.push_back(node.first + i);
    }
    end_[number] = next;
  }
  for (std::size_t i = walk.size(); i-- > 0;) {  // children before their parents
    const Tree::Node& node = tree.nodes[walk[i]];
    if (!node.is_leaf()) end_[walk[i]] = end_[node.first + node.count - 1];
  }
  std::ranges::sort(by_primitive_);
}

bool ReferenceSlots::owns(std::uint32_t node, std::uint32_t primitive) const {
  const auto first = std::ranges::lower_bound(by_primitive_, Slot{primitive, begin_[node]});
  return first != by_primitive_.end() && first->primitive == primitive && first->slot < end_[node];
}

}  // namespace boxwood
