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
/// depth first with siblings side by side; what a large one has left comes after all of them in the same way. How the
/// tree is cut depends on the tree alone.
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
    std::vector<Job> jobs{sinks_.local().write_top(root, nodes_ < small_tree ? 1 : wanted_jobs)};
    for (std::size_t wave = 0; wave < jobs.size();) {
      const std::size_t end = jobs.size();
      for (std::size_t parent = wave; parent < end; ++parent) {
        for (const Pending& pending : std::exchange(jobs[parent].open, {})) {
          jobs.push_back({.item = pending.item, .parent = parent, .place = pending.place});
        }
      }
      tbb::parallel_for(end, jobs.size(), [&](std::size_t j) { jobs[j] = sinks_.local().write(std::move(jobs[j])); });
      wave = end;
    }
    Tree tree;
    if (is_one_piece(jobs)) {
      tree.nodes = std::move(jobs.front().sink->nodes);
      tree.references = std::move(jobs.front().sink->references);
    } else {
      tree = put_together(jobs);
    }
    for (std::size_t j = 1; j < jobs.size(); ++j) tree.nodes[jobs[j].place] = jobs[j].root;
    return tree;
  }

 private:
  static constexpr std::size_t wanted_jobs = 256, small_tree = 4096;
  /// Nodes after which a job leaves the rest to others: a subtree can be most of the tree.
  static constexpr std::size_t job_nodes = 4096;
  static constexpr std::uint32_t most_levels = 64;

  struct Pending {
    Item item;
    std::uint32_t place;  ///< in the sink that writes it
  };

  struct Sink;
  /// A subtree without its root, or its upper part, and where in a sink it lies. The first job is all above the others.
  struct Job {
    Item item;
    std::size_t parent = 0;  ///< the job whose part has a place for the root
    std::size_t place = 0;   ///< that place, in that job's sink
    Tree::Node root = {};
    std::vector<Pending> open = {};  ///< what it leaves to other jobs
    Sink* sink = nullptr;
    std::size_t first_node = 0, first_reference = 0, end_node = 0, end_reference = 0;
  };

  /// What one thread has written. Nodes refer to places in it.
  struct Sink {
    Sink(std::size_t about_nodes, std::size_t about_references, decltype(std::declval<MakeExpand>()()) function)
        : expand(std::move(function)) {
      nodes.reserve(about_nodes);
      references.reserve(about_references);
    }

    /// The root and what is below it, level by level, until `wanted` nodes are open or none.
    Job write_top(const Item& root, std::size_t wanted) {
      Job job = begin({.item = root});
      nodes.emplace_back();
      job.open.push_back({root, 0});
      for (std::uint32_t level = 0; level < most_levels && !job.open.empty() && job.open.size() < wanted; ++level) {
        std::vector<Pending> next;
        for (const Pending& pending : job.open) expand_one(pending, next);
        job.open = std::move(next);
      }
      return end(std::move(job));
    }

    /// Writes what is below the job's item.
    Job write(Job job) {
      job = begin(std::move(job));
      stack.clear();
      job.root = expand_item(job.item, stack);
      while (!stack.empty() && nodes.size() - job.first_node < job_nodes) {
        const Pending pending = stack.back();
        stack.pop_back();
        const std::size_t before = stack.size();
        expand_one(pending, stack);
        std::reverse(stack.begin() + static_cast<std::ptrdiff_t>(before), stack.end());
      }
      job.open.assign(stack.rbegin(), stack.rend());
      return end(std::move(job));
    }

    Job begin(Job job) {
      job.sink = this;
      job.first_node = nodes.size();
      job.first_reference = references.size();
      return job;
    }

    Job end(Job job) const {
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
    Tree::Nodes nodes;
    Tree::References references;
    std::vector<Item> children;
    std::vector<Pending> stack;
  };

  /// Whether one thread has written everything, in order.
  static bool is_one_piece(const std::vector<Job>& jobs) {
    std::size_t end = 0;
    for (const Job& job : jobs) {
      if (job.sink != jobs.front().sink || job.first_node != end) return false;
      end = job.end_node;
    }
    return true;
  }

  /// The pieces one after the other. Sets all but the jobs' roots in the tree, those and their places in `jobs`.
  static Tree put_together(std::vector<Job>& jobs) {
    std::vector<std::size_t> node_places{0}, reference_places{0};
    for (const Job& job : jobs) {
      node_places.push_back(node_places.back() + job.end_node - job.first_node);
      reference_places.push_back(reference_places.back() + job.end_reference - job.first_reference);
    }
    Tree tree;
    tree.nodes = unwritten<Tree::Node>(node_places.back());
    tree.references = unwritten<std::uint32_t>(reference_places.back());
    tbb::parallel_for(std::size_t{0}, jobs.size(), [&](std::size_t j) {
      Job& job = jobs[j];
      const auto settled = [&](Tree::Node node) {
        node.first += static_cast<std::uint32_t>(node.is_leaf() ? reference_places[j] - job.first_reference
                                                                : node_places[j] - job.first_node);
        return node;
      };
      job.root = settled(job.root);
      job.place += node_places[job.parent] - jobs[job.parent].first_node;
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
