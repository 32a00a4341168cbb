#include "build/morton/cluster_block.h"

#include <algorithm>

namespace boxwood {
namespace {

/// Cache misses are started this many references ahead.
constexpr std::size_t prefetch_distance = 16;

}  // namespace

BlockBuilder::BlockBuilder(std::span<const Reference> references, const MortonOrder& order,
                           const ClusteringOptions& options)
    : references_(references), order_(order), stack_(block_size, 2 * kept_clusters, options), joins_(block_size) {}

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

void BlockBuilder::push_references(std::size_t begin, std::size_t end) {
  for (std::size_t i = begin; i < end; ++i) {
    if (i + prefetch_distance < references_.size()) {
      __builtin_prefetch(&references_[order_.reference(i + prefetch_distance)]);
    }
    const Box box = references_[order_.reference(i)].box();
    const auto place = static_cast<std::uint32_t>(i - block_begin_);
    stack_.push({box, ClusterId::given(place), place, 1, half_area(box)});
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
  written_nodes_.assign(block.roots.size(), {});
  written_references_.clear();
  const auto write_roots = [&](bool inner) {
    for (std::size_t root = 0; root < block.roots.size(); ++root) {
      if (block.roots[root].id.is_inner() != inner) continue;
      written_nodes_[root].bounds = block.roots[root].bounds;
      write_root(root, block.roots[root].id);
    }
  };
  write_roots(false);
  block.loose_references = written_references_.size();
  write_roots(true);
  // Copies of the right size: the memory that grew is kept for the next block.
  block.nodes = written_nodes_;
  block.references = written_references_;
}

void BlockBuilder::write_root(std::size_t root, ClusterId id) {
  writer_.write(joins_.data(), id, root, written_nodes_, [&](Tree::Node& node, ClusterId leaf) {
    node.leaf = 1;
    node.first = static_cast<std::uint32_t>(written_references_.size());
    write_references(leaf);
    node.count = (static_cast<std::uint32_t>(written_references_.size()) - node.first) & Tree::max_count;
  });
}

/// Recursion is no deeper than a leaf has references.
void BlockBuilder::write_references(ClusterId id) {
  if (id.is_given()) {
    written_references_.push_back(references_[order_.reference(block_begin_ + id.number())].primitive);
    return;
  }
  write_references(joins_[id.number()].left);
  write_references(joins_[id.number()].right);
}

}  // namespace boxwood
