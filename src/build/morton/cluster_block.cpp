#include "build/morton/cluster_block.h"

#include <tbb/task_arena.h>

#include <algorithm>

#include "build/float4.h"

namespace boxwood {
namespace {

/// Cache misses are started this many references ahead.
constexpr std::size_t prefetch_distance = 16;

/// Of the leaf that the run becomes with one more reference, whose box is `grown`.
float cost_with_one_more(const Cluster& run, const Box& grown, std::uint32_t leaf_block) {
  const std::uint32_t blocks = run.leaf_references / leaf_block + 1;
  return half_area(grown) * static_cast<float>(blocks);
}

}  // namespace

BlockBuilder::BlockBuilder(std::span<const Reference> references, const MortonOrder& order,
                           const ClusteringOptions& options)
    : references_(references),
      order_(order),
      options_(options),
      stack_(block_size, 2 * kept_clusters, options),
      runs_(block_size),
      joins_(block_size) {
  // This thread's share: memory that stays untouched costs nothing, growing does.
  const std::size_t share = references.size() / static_cast<std::size_t>(tbb::this_task_arena::max_concurrency());
  written_nodes_.reserve(2 * share);
  written_references_.reserve(share);
}

ClusterBlock BlockBuilder::build(std::size_t begin, std::size_t end, std::size_t target) {
  stack_.clear();
  block_begin_ = begin;
  join(begin, end, target);
  ClusterBlock block;
  block.roots.reserve(stack_.size());
  for (std::size_t i = 0; i < stack_.size(); ++i) block.roots.push_back(stack_[i]);
  write(block);
  return block;
}

/// Whether the references of a run are cheaper together with the next one than beside it. Costs leave out the node
/// above: what is joined here cannot be parted later, so it has to pay for itself.
bool BlockBuilder::extends(const Cluster& run, const Box& grown, const Box& next) const {
  return run.leaf_references < options_.run &&
         cost_with_one_more(run, grown, options_.leaf_block) <= run.cost + half_area(next);
}

/// Pushes the references as clusters, one each or in runs.
void BlockBuilder::push_references(std::size_t begin, std::size_t end) {
  Cluster run;
  for (std::size_t i = begin; i < end; ++i) {
    if (i + prefetch_distance < references_.size()) {
      __builtin_prefetch(&references_[order_.reference(i + prefetch_distance)]);
    }
    const Box box = references_[order_.reference(i)].box();
    const Box grown = unite(run.bounds, box);
    if (i > begin && extends(run, grown, box)) {
      run.bounds = grown;
      run.cost = cost_with_one_more(run, grown, options_.leaf_block);
      ++run.leaf_references;
    } else {
      if (i > begin) push_run(run);
      const auto place = static_cast<std::uint32_t>(i - block_begin_);
      run = {box, ClusterId::given(place), place, 1, half_area(box)};
    }
  }
  push_run(run);
}

void BlockBuilder::push_run(const Cluster& run) {
  runs_[run.free_slot] = run.leaf_references;
  stack_.push(run);
}

/// Leaves at most `target` clusters for [begin, end) on the stack.
void BlockBuilder::join(std::size_t begin, std::size_t end, std::size_t target) {
  const std::size_t bottom = stack_.size();
  if (end - begin <= 2 * kept_clusters) {
    push_references(begin, end);
  } else {
    const std::size_t middle = order_.split(begin, end);
    join(begin, middle, kept_clusters);
    join(middle, end, kept_clusters);
  }
  stack_.reduce(bottom, target, joins_.data());
}

void BlockBuilder::write(ClusterBlock& block) {
  first_node_ = written_nodes_.size();
  first_reference_ = written_references_.size();
  written_nodes_.resize(first_node_ + block.roots.size());
  const auto write_roots = [&](bool inner) {
    for (std::size_t root = 0; root < block.roots.size(); ++root) {
      if (block.roots[root].id.is_inner() != inner) continue;
      written_nodes_[first_node_ + root].bounds = block.roots[root].bounds;
      write_root(root, block.roots[root].id);
    }
  };
  write_roots(false);
  block.loose_references = written_references_.size() - first_reference_;
  write_roots(true);
  block.all_nodes = &written_nodes_;
  block.all_references = &written_references_;
  block.first_node = first_node_;
  block.node_count = written_nodes_.size() - first_node_;
  block.first_reference = first_reference_;
  block.reference_count = written_references_.size() - first_reference_;
}

void BlockBuilder::write_root(std::size_t root, ClusterId id) {
  writer_.write(joins_.data(), id, first_node_, root, written_nodes_, [&](Tree::Node& node, ClusterId leaf) {
    const std::size_t first = written_references_.size();
    node.leaf = 1;
    node.first = static_cast<std::uint32_t>(first - first_reference_);
    write_references(leaf);
    node.count = static_cast<std::uint32_t>(written_references_.size() - first) & Tree::max_count;
  });
}

/// Recursion is no deeper than a leaf has references.
void BlockBuilder::write_references(ClusterId id) {
  if (id.is_given()) {
    const std::size_t first = block_begin_ + id.number();
    for (std::size_t i = first; i < first + runs_[id.number()]; ++i) {
      written_references_.push_back(references_[order_.reference(i)].primitive);
    }
    return;
  }
  write_references(joins_[id.number()].left);
  write_references(joins_[id.number()].right);
}

}  // namespace boxwood
