#pragma once
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "build/morton/cluster_tree.h"
#include "tree/child_axis.h"
#include "tree/tree.h"

namespace boxwood {

/// Writes joined clusters out as tree nodes, depth first with siblings side by side.
class SubtreeWriter {
 public:
  /// Sets out[place], whose bounds are there already, and appends all that is below `id` to `out`.
  /// finish(out[node], id) is called for what is not an inner node, its bounds set. An explicit stack: trees may be
  /// deep.
  template <class Finish>
  void write(const ClusterNode* nodes, ClusterId id, std::size_t place, std::vector<Tree::Node>& out, Finish&& finish) {
    visit(id, static_cast<std::uint32_t>(place), out, finish);
    while (!pending_.empty()) {
      const auto [slot, node] = pending_.back();
      pending_.pop_back();
      const ClusterNode& from = nodes[slot];
      const ChildAxis axis = child_axis(from.left_bounds, from.right_bounds);
      const auto first = static_cast<std::uint32_t>(out.size());
      out[node].first = first;
      out[node].count = 2;
      out[node].axis = axis.axis & 3;
      out.emplace_back().bounds = axis.descending ? from.right_bounds : from.left_bounds;
      out.emplace_back().bounds = axis.descending ? from.left_bounds : from.right_bounds;
      visit(axis.descending ? from.left : from.right, first + 1, out, finish);
      visit(axis.descending ? from.right : from.left, first, out, finish);
    }
  }

 private:
  struct Pending {
    std::uint32_t slot, node;
  };

  template <class Finish>
  void visit(ClusterId id, std::uint32_t node, std::vector<Tree::Node>& out, Finish& finish) {
    if (id.is_inner()) {
      pending_.push_back({id.number(), node});
    } else {
      finish(out[node], id);
    }
  }

  std::vector<Pending> pending_;
};

}  // namespace boxwood
