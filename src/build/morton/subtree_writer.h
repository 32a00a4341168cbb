#pragma once
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "build/morton/cluster_tree.h"
#include "math/large_memory.h"
#include "tree/child_axis.h"
#include "tree/tree.h"

namespace boxwood {

/// Writes joined clusters out as tree nodes, depth first with siblings side by side. Nodes of more than two children
/// are made by opening the largest child that fits as long as there is room: the tree's collapse, without the binary
/// tree.
class SubtreeWriter {
 public:
  struct Child {
    const Box* bounds;
    ClusterId id;
    std::uint32_t parts;  ///< that opening it gives; 0 when it cannot be opened
    float area;           ///< half of it; of what cannot be opened -1
  };
  static Child leaf(const Box& bounds, ClusterId id) { return {&bounds, id, 0, -1}; }

  /// What write() takes where no cluster is a group.
  struct NoGroups {
    std::uint32_t size(ClusterId) const { return 0; }
    void open(ClusterId, Child*) const {}
  };

  /// `width`: most children of a node, 2…max_cluster_width.
  explicit SubtreeWriter(std::uint32_t width) : width_(width) {}

  /// Sets out[begin + place], whose bounds are there already, and appends all that is below `id` to `out`; places are
  /// counted from `begin`. finish(node, id) is called for what is not an inner node, its bounds set;
  /// groups.size(id) and groups.open(id, children) tell what groups consist of. An explicit stack:
  /// trees may be deep.
  template <class Groups, class Finish>
  void write(const ClusterNode* nodes, const Groups& groups, ClusterId id, std::size_t begin, std::size_t place,
             LargeVector<Tree::Node>& out, Finish&& finish) {
    if (!id.is_inner()) return finish(out[begin + place], id);
    pending_.push_back({id.number(), static_cast<std::uint32_t>(place)});
    while (!pending_.empty()) {
      const Pending next = pending_.back();
      pending_.pop_back();
      write_one(nodes, groups, next, begin, out, finish, pending_);
    }
  }

  /// An inner node that is to be written.
  struct Pending {
    std::uint32_t slot, node;  ///< its join, its place
  };

  /// Sets one node and appends its children to `out`; those of them that are inner nodes to `pending`, the first last.
  template <class Groups, class Finish>
  void write_one(const ClusterNode* nodes, const Groups& groups, Pending at, std::size_t begin,
                 LargeVector<Tree::Node>& out, Finish&& finish, std::vector<Pending>& pending) {
    gather_children(nodes, groups, at.slot);
    const auto first = static_cast<std::uint32_t>(out.size() - begin);
    out.resize(out.size() + count_);
    Tree::Node* block = out.data() + begin;
    block[at.node].first = first;
    block[at.node].count = count_ & Tree::max_count;
    block[at.node].axis = axis_ & 3;
    for (std::uint32_t c = 0; c < count_; ++c) {
      block[first + c].bounds = *children_[c].bounds;
      if (!children_[c].id.is_inner()) finish(block[first + c], children_[c].id);
    }
    for (std::uint32_t c = count_; c-- > 0;) {
      if (children_[c].id.is_inner()) pending.push_back({children_[c].id.number(), first + c});
    }
  }

 private:
  template <class Groups>
  void gather_children(const ClusterNode* nodes, const Groups& groups, std::uint32_t slot) {
    axis_ = put_pair(nodes[slot], groups, 0);
    count_ = 2;
    for (;;) {
      std::uint32_t largest = count_;
      float largest_area = -1;
      for (std::uint32_t c = 0; c < count_; ++c) {
        if (children_[c].area <= largest_area || count_ - 1 + children_[c].parts > width_) continue;
        largest = c;
        largest_area = children_[c].area;
      }
      if (largest == count_) return;
      const Child opened = children_[largest];
      std::copy_backward(children_ + largest + 1, children_ + count_, children_ + count_ - 1 + opened.parts);
      count_ += opened.parts - 1;
      axis_ = Tree::mixed_axis;  // Parts of parts need not ascend.
      if (opened.id.is_group()) {
        groups.open(opened.id, children_ + largest);
      } else {
        put_pair(nodes[opened.id.number()], groups, largest);
      }
    }
  }

  /// The two parts of a join, ascending along the axis that is returned.
  template <class Groups>
  std::uint32_t put_pair(const ClusterNode& from, const Groups& groups, std::uint32_t place) {
    const auto child = [&](const Box& bounds, ClusterId id) {
      if (id.is_leaf()) return leaf(bounds, id);
      return Child{&bounds, id, id.is_group() ? groups.size(id) : 2, half_area(bounds)};
    };
    const ChildAxis axis = child_axis(from.left_bounds, from.right_bounds);
    const Child left = child(from.left_bounds, from.left), right = child(from.right_bounds, from.right);
    children_[place] = axis.descending ? right : left;
    children_[place + 1] = axis.descending ? left : right;
    return axis.axis;
  }

  std::uint32_t width_;
  Child children_[max_cluster_width];
  std::uint32_t count_ = 0, axis_ = 0;  ///< of the node that is being written
  std::vector<Pending> pending_;
};

}  // namespace boxwood
