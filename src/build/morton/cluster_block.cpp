#include "build/morton/cluster_block.h"

#include <tbb/task_arena.h>

#include <algorithm>

#include "build/float4.h"

namespace boxwood {
namespace {

/// Cache misses are started this many references ahead.
constexpr std::size_t prefetch_distance = 16;

/// References next to each other on the curve that are one cluster from the start.
struct Run {
  Box4 bounds;
  std::uint32_t place = 0;  ///< of the first
  std::uint32_t references = 0;
  float cost = 0;
};

}  // namespace

BlockBuilder::BlockBuilder(std::span<const Reference> references, const MortonOrder& order,
                           const ClusteringOptions& options)
    : references_(references),
      order_(order),
      options_(options),
      stack_(block_size, 2 * kept_clusters, options),
      primitives_(block_size),
      runs_(block_size),
      joins_(block_size),
      writer_(options.width) {
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

/// Pushes the references as clusters, one each or in runs: a run is extended where its references are no dearer
/// together with the next one than beside it. Costs leave out the node above: what is joined here cannot be parted
/// later, so it has to pay for itself.
void BlockBuilder::push_references(std::size_t begin, std::size_t end) {
  const auto push = [&](const Run& run) {
    runs_[run.place] = run.references;
    stack_.push({run.bounds.box(), ClusterId::given(run.place), run.place, run.references, run.cost});
  };
  Run run;
  for (std::size_t i = begin; i < end; ++i) {
    if (i + prefetch_distance < references_.size()) {
      __builtin_prefetch(&references_[order_.reference(i + prefetch_distance)]);
    }
    const Reference& reference = references_[order_.reference(i)];
    primitives_[i - block_begin_] = reference.primitive;
    const Box4 box = box4(reference);
    const float area = half_area(box);
    Box4 grown = run.bounds;
    grown.grow(box);
    const float grown_cost = half_area(grown) * static_cast<float>(run.references / options_.leaf_block + 1);
    if (i > begin && run.references < options_.run && grown_cost <= run.cost + area) {
      run = {grown, run.place, run.references + 1, grown_cost};
    } else {
      if (i > begin) push(run);
      run = {box, static_cast<std::uint32_t>(i - block_begin_), 1, area};
    }
  }
  push(run);
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
    const std::uint32_t* const first = &primitives_[id.number()];
    written_references_.insert(written_references_.end(), first, first + runs_[id.number()]);
    return;
  }
  write_references(joins_[id.number()].left);
  write_references(joins_[id.number()].right);
}

}  // namespace boxwood
