#pragma once
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "tree/tree.h"

namespace boxwood {

/// References as the leaves count them: encoders get the tree without the list.
inline std::size_t reference_count(const Tree& tree) {
  std::size_t count = 0;
  for (const Tree::Node& node : tree.nodes) {
    if (node.is_leaf()) count = std::max(count, std::size_t{node.first} + node.count);
  }
  return count;
}

/// Where leaves end, for nodes that have no room for a count: one bit per reference, set at the last one of each leaf.
/// Empty, and free, when every leaf has one reference, as in the study.
class LeafEnds {
 public:
  LeafEnds() = default;
  explicit LeafEnds(const Tree& tree) {
    bool single = true;
    for (const Tree::Node& node : tree.nodes) single &= !node.is_leaf() || node.count == 1;
    if (single) return;
    bits_.resize(reference_count(tree) / 64 + 1);
    for (const Tree::Node& node : tree.nodes) {
      if (!node.is_leaf()) continue;
      const std::size_t last = std::size_t{node.first} + node.count - 1;
      bits_[last / 64] |= std::uint64_t{1} << last % 64;
    }
  }

  /// References of the leaf that starts at `first`.
  std::uint32_t count_from(std::uint32_t first) const {
    if (bits_.empty()) return 1;
    std::uint32_t last = first;
    while ((bits_[last / 64] >> last % 64 & 1) == 0) ++last;
    return last - first + 1;
  }

  std::size_t bytes() const { return bits_.size() * sizeof(std::uint64_t); }

 private:
  std::vector<std::uint64_t> bits_;
};

}  // namespace boxwood
