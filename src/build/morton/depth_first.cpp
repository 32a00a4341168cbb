#include "build/morton/depth_first.h"

#include <tbb/parallel_for.h>

#include <utility>
#include <vector>

#include "tree/child_axis.h"

namespace boxwood {
namespace {

/// A subtree still to be written: its root's place is taken, its other nodes begin at `next_node`.
struct Pending {
  ClusterId id;
  std::uint32_t node, next_node, next_reference;
};

class Writer {
 public:
  Writer(const ClusterTree& clusters, std::span<const Reference> references, const MortonOrder& order)
      : clusters_(clusters), references_(references), order_(order) {}

  Tree run() {
    tree_.nodes.resize(clusters_.size_of(clusters_.root).nodes);
    tree_.references.resize(references_.size());
    // The top serially, down to subtrees that one task can write.
    constexpr std::uint32_t task_nodes = 1 << 13;
    std::vector<Pending> top{{clusters_.root, 0, 1, 0}}, tasks;
    while (!top.empty()) {
      const Pending pending = top.back();
      top.pop_back();
      if (clusters_.size_of(pending.id).nodes > task_nodes) {
        write(pending, top);
      } else {
        tasks.push_back(pending);
      }
    }
    tbb::parallel_for(std::size_t{0}, tasks.size(), [&](std::size_t t) {
      std::vector<Pending> stack{tasks[t]};
      while (!stack.empty()) {
        const Pending pending = stack.back();
        stack.pop_back();
        write(pending, stack);
      }
    });
    return std::move(tree_);
  }

 private:
  const Reference& reference(ClusterId id) const { return references_[order_.reference(id.place())]; }
  Box bounds(ClusterId id) const { return id.is_reference() ? reference(id).box() : clusters_.nodes[id.bits].bounds; }

  void write(const Pending& pending, std::vector<Pending>& stack) {
    Tree::Node& node = tree_.nodes[pending.node];
    const ClusterTree::Size size = clusters_.size_of(pending.id);
    node.bounds = bounds(pending.id);
    if (size.nodes == 1) {
      node.leaf = 1;
      node.first = pending.next_reference;
      node.count = size.references & Tree::max_count;
      std::uint32_t* next = &tree_.references[pending.next_reference];
      write_references(pending.id, next);
      return;
    }
    ClusterId left = clusters_.nodes[pending.id.bits].left, right = clusters_.nodes[pending.id.bits].right;
    const ChildAxis axis = child_axis(bounds(left), bounds(right));
    if (axis.descending) std::swap(left, right);
    node.first = pending.next_node;
    node.count = 2;
    node.axis = axis.axis & 3;
    const ClusterTree::Size left_size = clusters_.size_of(left);
    const std::uint32_t below = pending.next_node + 2;
    stack.push_back(
        {right, pending.next_node + 1, below + left_size.nodes - 1, pending.next_reference + left_size.references});
    stack.push_back({left, pending.next_node, below, pending.next_reference});
  }

  /// Recursion is no deeper than a leaf has references.
  void write_references(ClusterId id, std::uint32_t*& next) const {
    if (id.is_reference()) {
      *next++ = reference(id).primitive;
      return;
    }
    write_references(clusters_.nodes[id.bits].left, next);
    write_references(clusters_.nodes[id.bits].right, next);
  }

  const ClusterTree& clusters_;
  std::span<const Reference> references_;
  const MortonOrder& order_;
  Tree tree_;
};

}  // namespace

Tree write_depth_first(const ClusterTree& clusters, std::span<const Reference> references, const MortonOrder& order) {
  return Writer(clusters, references, order).run();
}

}  // namespace boxwood
