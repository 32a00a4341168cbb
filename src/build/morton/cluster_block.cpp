#include "build/morton/cluster_block.h"

#include <tbb/task_arena.h>

#include <algorithm>

namespace boxwood {
namespace {

/// A run joins a group unless that makes the group's node larger by more than this many times the run. A node that is
/// not made costs at least its own children's areas in the node above; 1 to 8 were tried, larger ones are quicker to
/// build.
constexpr float group_slack = 4;

/// Cache misses are started this many references ahead.
constexpr std::size_t prefetch_distance = 16;

}  // namespace

BlockBuilder::BlockBuilder(std::span<const Reference> references, const MortonOrder& order,
                           const ClusteringOptions& options)
    : references_(references),
      order_(order),
      options_(options),
      slack_of_large_(std::min(options.slack, 1 / LargeLeaf::most_in_halves)),
      stack_(block_size, 2 * kept_clusters, options),
      primitives_(block_size),
      runs_(block_size),
      groups_(block_size),
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

/// Pushes the references as clusters, one each or in runs: a run is extended where its references are at most
/// `slack` times as dear together with the next one as beside it. Costs leave out the node above: what is joined here
/// cannot be parted later, so it has to pay for itself.
void BlockBuilder::push_references(std::size_t begin, std::size_t end) {
  Run run;
  Box4 bounds;  // the run's
  Group group;
  for (std::size_t i = begin; i < end; ++i) {
    if (i + prefetch_distance < references_.size()) {
      __builtin_prefetch(&references_[order_.reference(i + prefetch_distance)]);
    }
    const Reference& reference = references_[order_.reference(i)];
    primitives_[i - block_begin_] = reference.primitive;
    const Box4 box = box4(reference);
    const float area = half_area(box);
    Box4 grown = bounds;
    grown.grow(box);
    const std::uint32_t blocks = run.references / options_.leaf_block + 1;
    const float grown_area = half_area(grown), grown_cost = grown_area * static_cast<float>(blocks);
    const float slack = options_.large_leaf.is_large(grown_area) ? slack_of_large_ : options_.slack;
    if (i > begin && run.references < options_.run && grown_cost <= slack * (run.cost + area)) {
      bounds = grown;
      run.cost = grown_cost;
      ++run.references;
    } else {
      if (i > begin) add_run(run, bounds, group);
      bounds = box;
      run = {{}, static_cast<std::uint32_t>(i - block_begin_), 1, area};
    }
  }
  add_run(run, bounds, group);
  push(group);
}

/// Adds a run to the group where a node around both is not much larger than the group's and the run's, or begins a new
/// group.
void BlockBuilder::add_run(const Run& run, const Box4& bounds, Group& group) {
  runs_[run.place] = {bounds.box(), run.place, run.references, run.cost};
  const float run_area = half_area(bounds);
  Box4 grown = group.bounds;
  grown.grow(bounds);
  const float grown_area = half_area(grown);
  if (group.runs > 0 && group.runs < options_.group && grown_area <= group.area + group_slack * run_area) {
    group = {grown, group.place, group.runs + 1, grown_area, group.cost + run.cost};
  } else {
    if (group.runs > 0) push(group);
    group = {bounds, run.place, 1, run_area, run.cost};
  }
}

void BlockBuilder::push(const Group& group) {
  const Box bounds = group.bounds.box();
  if (group.runs == 1) {
    stack_.push({bounds, ClusterId::given(group.place), group.place, runs_[group.place].references, group.cost});
  } else {
    groups_[group.place] = group.runs;
    stack_.push({bounds, ClusterId::group(group.place), group.place, 0, group.area + group.cost});
  }
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
      if (block.roots[root].id.is_leaf() == inner) continue;
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
  open_groups_.clear();
  writer_.write(joins_.data(), Groups{*this}, id, first_node_, root, written_nodes_,
                [&](Tree::Node& node, ClusterId below) {
                  if (below.is_group()) {
                    open_groups_.push_back({static_cast<std::size_t>(&node - written_nodes_.data()), below.number()});
                    return;
                  }
                  const std::size_t first = written_references_.size();
                  node.leaf = 1;
                  node.first = static_cast<std::uint32_t>(first - first_reference_);
                  write_references(below);
                  node.count = static_cast<std::uint32_t>(written_references_.size() - first) & Tree::max_count;
                });
  for (const OpenGroup& group : open_groups_) write_group(group);
}

void BlockBuilder::Groups::open(ClusterId id, SubtreeWriter::Child* children) const {
  std::uint32_t place = id.number();
  for (std::uint32_t left = size(id); left > 0; --left) {
    const Run& run = builder.runs_[place];
    *children++ = SubtreeWriter::leaf(run.bounds, ClusterId::given(place));
    place += run.references;
  }
}

void BlockBuilder::write_group(const OpenGroup& group) {
  const std::uint32_t count = groups_[group.place];
  const std::size_t first = written_nodes_.size();
  written_nodes_.resize(first + count);
  written_nodes_[group.node].first = static_cast<std::uint32_t>(first - first_node_);
  written_nodes_[group.node].count = count & Tree::max_count;
  std::uint32_t place = group.place;
  for (std::size_t child = first; child < first + count; ++child) {
    const Run& run = runs_[place];
    Tree::Node& leaf = written_nodes_[child];
    leaf.bounds = run.bounds;
    leaf.leaf = 1;
    leaf.first = static_cast<std::uint32_t>(written_references_.size() - first_reference_) + place - group.place;
    leaf.count = run.references & Tree::max_count;
    place += run.references;
  }
  written_references_.insert(written_references_.end(), &primitives_[group.place], &primitives_[place]);
}

/// Recursion is no deeper than a leaf has references.
void BlockBuilder::write_references(ClusterId id) {
  if (id.is_given()) {
    const std::uint32_t* const first = &primitives_[id.number()];
    written_references_.insert(written_references_.end(), first, first + runs_[id.number()].references);
    return;
  }
  write_references(joins_[id.number()].left);
  write_references(joins_[id.number()].right);
}

}  // namespace boxwood
