#pragma once
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "build/morton/cluster_tree.h"
#include "math/large_memory.h"
#include "tree/child_axis.h"
#include "tree/tree.h"

namespace boxwood {

/// Writes joined clusters out as tree nodes, depth first with siblings side by side.
class SubtreeWriter {
 public:
  /// Sets out[begin + place], whose bounds are there already, and appends all that is below `id` to `out`; places are
  /// counted from `begin`. finish(node, id) is called for what is not an inner node, its bounds set. An explicit stack:
  /// trees may be deep.
  template <class Finish>
  void write(const ClusterNode* nodes, ClusterId id, std::size_t begin, std::size_t place, LargeVector<Tree::Node>& out,
             Finish&& finish) {
    visit(id, static_cast<std::uint32_t>(place), out.data() + begin, finish);
    while (!pending_.empty()) {
      const auto [slot, node] = pending_.back();
      pending_.pop_back();
      const ClusterNode& from = nodes[slot];
      const ChildAxis axis = child_axis(from.left_bounds, from.right_bounds);
      const auto first = static_cast<std::uint32_t>(out.size() - begin);
      out.resize(out.size() + 2);
      Tree::Node* block = out.data() + begin;
      block[node].first = first;
      block[node].count = 2;
      block[node].axis = axis.axis & 3;
      block[first].bounds = axis.descending ? from.right_bounds : from.left_bounds;
      block[first + 1].bounds = axis.descending ? from.left_bounds : from.right_bounds;
      visit(axis.descending ? from.left : from.right, first + 1, block, finish);
      visit(axis.descending ? from.right : from.left, first, block, finish);
    }
  }

 private:
  struct Pending {
    std::uint32_t slot, node;
  };

  template <class Finish>
  void visit(ClusterId id, std::uint32_t node, Tree::Node* block, Finish& finish) {
    if (id.is_inner()) {
      pending_.push_back({id.number(), node});
    } else {
      finish(block[node], id);
    }
  }

  std::vector<Pending> pending_;
};

}  // namespace boxwood
