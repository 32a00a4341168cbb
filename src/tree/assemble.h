#pragma once
#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "math/large_memory.h"
#include "tree/tree.h"

namespace boxwood {

/// Writes a tree from its root down. An item stands for a node still to be written;
/// expand(item, node, children, references) sets everything of `node` but where its children are, and either appends
/// the items of two or more children, or makes it a leaf: sets node.leaf, appends to `references` and sets node.first
/// to where they begin. `make_expand()` makes such a function, one per thread, so that it may have scratch.
///
/// Parallel: the nodes near the root come first, level by level, then the subtrees below them one after the other, each
/// depth first with siblings side by side. How the tree is cut depends on the tree alone.
template <class Item, class MakeExpand>
class TreeAssembler {
 public:
  /// About `nodes` nodes and `references` references will be written.
  TreeAssembler(std::size_t nodes, std::size_t references, const MakeExpand& make_expand)
      : nodes_(nodes), references_(references), sinks_([this, &make_expand] {
          const auto threads = static_cast<std::size_t>(tbb::this_task_arena::max_concurrency());
          return Sink(nodes_ / threads, references_ / threads, make_expand());
        }) {}

  Tree run(const Item& root) {
    std::vector<Pending> open{{root, 0}};
    const std::size_t wanted_jobs = nodes_ < small_tree ? 1 : jobs;
    Sink& top = sinks_.local();
    top.nodes.emplace_back();
    for (std::uint32_t level = 0; level < most_levels && !open.empty() && open.size() < wanted_jobs; ++level) {
      std::vector<Pending> next;
      for (const Pending& pending : open) top.expand_one(pending, next);
      open = std::move(next);
    }
    const Job top_job = {&top, {}, 0, 0, top.nodes.size(), top.references.size()};
    std::vector<Job> all(open.size());
    tbb::parallel_for(std::size_t{0}, open.size(), [&](std::size_t j) { all[j] = sinks_.local().write(open[j].item); });
    Tree tree;
    if (is_one_piece(top_job, all)) {
      tree.nodes = std::move(top.nodes);
      tree.references = std::move(top.references);
    } else {
      tree = put_together(top_job, all);
    }
    for (std::size_t j = 0; j < all.size(); ++j) tree.nodes[open[j].place] = all[j].root;
    return tree;
  }

 private:
  static constexpr std::size_t jobs = 256, small_tree = 4096;
  static constexpr std::uint32_t most_levels = 64;

  struct Pending {
    Item item;
    std::uint32_t place;  ///< in the sink that writes it
  };

  struct Sink;
  /// A subtree: its root, and where in a sink the rest of it lies.
  struct Job {
    Sink* sink = nullptr;
    Tree::Node root;
    std::size_t first_node = 0, first_reference = 0, end_node = 0, end_reference = 0;
  };

  /// What one thread has written. Nodes refer to places in it.
  struct Sink {
    Sink(std::size_t about_nodes, std::size_t about_references, decltype(std::declval<MakeExpand>()()) function)
        : expand(std::move(function)) {
      reserve_large(nodes, about_nodes);
      reserve_large(references, about_references);
    }

    /// Writes all that is below an item.
    Job write(const Item& item) {
      Job job{this, {}, nodes.size(), references.size(), 0, 0};
      stack.clear();
      job.root = expand_item(item, stack);
      while (!stack.empty()) {
        const Pending pending = stack.back();
        stack.pop_back();
        const std::size_t before = stack.size();
        expand_one(pending, stack);
        std::reverse(stack.begin() + static_cast<std::ptrdiff_t>(before), stack.end());
      }
      job.end_node = nodes.size();
      job.end_reference = references.size();
      return job;
    }

    void expand_one(const Pending& pending, std::vector<Pending>& next) {
      nodes[pending.place] = expand_item(pending.item, next);
    }

    /// Makes room for the children, which are appended to `next`.
    Tree::Node expand_item(const Item& item, std::vector<Pending>& next) {
      children.clear();
      Tree::Node node;
      expand(item, node, children, references);
      if (node.is_leaf()) return node;
      node.first = static_cast<std::uint32_t>(nodes.size());
      node.count = static_cast<std::uint32_t>(children.size()) & Tree::max_count;
      nodes.resize(nodes.size() + children.size());
      for (std::uint32_t i = 0; i < children.size(); ++i) next.push_back({children[i], node.first + i});
      return node;
    }

    decltype(std::declval<MakeExpand>()()) expand;
    std::vector<Tree::Node> nodes;
    std::vector<std::uint32_t> references;
    std::vector<Item> children;
    std::vector<Pending> stack;
  };

  /// Whether one thread has written everything, in order.
  static bool is_one_piece(const Job& top, const std::vector<Job>& all) {
    std::size_t end = top.end_node;
    for (const Job& job : all) {
      if (job.sink != top.sink || job.first_node != end) return false;
      end = job.end_node;
    }
    return true;
  }

  /// The pieces one after the other. Sets all but the jobs' roots in the tree, those in `all`.
  static Tree put_together(const Job& top, std::vector<Job>& all) {
    std::vector<std::size_t> node_places{top.end_node}, reference_places{top.end_reference};
    for (const Job& job : all) {
      node_places.push_back(node_places.back() + job.end_node - job.first_node);
      reference_places.push_back(reference_places.back() + job.end_reference - job.first_reference);
    }
    Tree tree;
    reserve_large(tree.nodes, node_places.back());
    reserve_large(tree.references, reference_places.back());
    tree.nodes.resize(node_places.back());
    tree.references.resize(reference_places.back());
    std::copy_n(top.sink->nodes.begin(), top.end_node, tree.nodes.begin());
    std::copy_n(top.sink->references.begin(), top.end_reference, tree.references.begin());
    tbb::parallel_for(std::size_t{0}, all.size(), [&](std::size_t j) {
      Job& job = all[j];
      const auto settled = [&](Tree::Node node) {
        node.first += static_cast<std::uint32_t>(node.is_leaf() ? reference_places[j] - job.first_reference
                                                                : node_places[j] - job.first_node);
        return node;
      };
      job.root = settled(job.root);
      std::transform(job.sink->nodes.data() + job.first_node, job.sink->nodes.data() + job.end_node,
                     tree.nodes.data() + node_places[j], settled);
      std::copy(job.sink->references.data() + job.first_reference, job.sink->references.data() + job.end_reference,
                tree.references.data() + reference_places[j]);
    });
    return tree;
  }

  std::size_t nodes_, references_;
  tbb::enumerable_thread_specific<Sink> sinks_;
};

template <class Item, class MakeExpand>
Tree assemble(const Item& root, std::size_t nodes, std::size_t references, const MakeExpand& make_expand) {
  return TreeAssembler<Item, MakeExpand>(nodes, references, make_expand).run(root);
}

}  // namespace boxwood
