#include "build/morton/clustering.h"

#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>
#include <tbb/parallel_invoke.h>

#include <algorithm>
#include <vector>

#include "build/morton/cluster_block.h"
#include "build/morton/cluster_stack.h"
#include "math/large_memory.h"

namespace boxwood {
namespace {

class Clustering {
 public:
  Clustering(std::span<const Reference> references, const MortonOrder& order, const ClusteringOptions& options)
      : order_(order),
        width_(options.width),
        count_(references.size()),
        builders_([=, &order] { return BlockBuilder(references, order, options); }),
        stacks_([=] { return ClusterStack(2 * kept_clusters, 2 * kept_clusters, options); }) {}

  Tree run() {
    cut(0, count_);
    unite_small_blocks();
    blocks_.resize(begins_.size());
    joins_ = RawArray<ClusterNode>(blocks_.size() * kept_clusters);
    const std::vector<Cluster> top = join(0, begins_.size());
    write(top.front());
    return std::move(tree_);
  }

 private:
  /// Cuts the curve into blocks where its Morton tree would.
  void cut(std::size_t begin, std::size_t end) {
    if (end - begin <= BlockBuilder::block_size) {
      begins_.push_back(begin);
    } else {
      const std::size_t middle = order_.split(begin, end);
      cut(begin, middle);
      cut(middle, end);
    }
  }

  /// Neighbouring blocks that fit into one become one: references in a block too small to join would stay single.
  void unite_small_blocks() {
    std::vector<std::size_t> united{0};
    for (std::size_t b = 1; b < begins_.size(); ++b) {
      if (begin_of(b + 1) - united.back() > BlockBuilder::block_size) united.push_back(begins_[b]);
    }
    begins_ = std::move(united);
  }

  std::size_t begin_of(std::size_t block) const { return block < begins_.size() ? begins_[block] : count_; }

  /// Joins the blocks [first, last) until few clusters are left; one for all of them.
  std::vector<Cluster> join(std::size_t first, std::size_t last) {
    const bool whole = last - first == begins_.size();
    const std::size_t target = whole ? 1 : kept_clusters;
    if (last - first == 1) return build_block(first, target);
    const std::size_t split = order_.split(begin_of(first), begin_of(last));
    const auto nearest = std::lower_bound(begins_.begin(), begins_.end(), split) - begins_.begin();
    const std::size_t middle = std::clamp(static_cast<std::size_t>(nearest), first + 1, last - 1);
    std::vector<Cluster> left, right;
    tbb::parallel_invoke([&] { left = join(first, middle); }, [&] { right = join(middle, last); });
    // No task is started from here on, so this thread's stack is free.
    ClusterStack& stack = stacks_.local();
    stack.clear();
    for (const Cluster& cluster : left) stack.push(cluster);
    for (const Cluster& cluster : right) stack.push(cluster);
    stack.reduce(0, target, joins_.data());
    std::vector<Cluster> joined;
    joined.reserve(stack.size());
    for (std::size_t i = 0; i < stack.size(); ++i) joined.push_back(stack[i]);
    return joined;
  }

  std::vector<Cluster> build_block(std::size_t block, std::size_t target) {
    blocks_[block] = builders_.local().build(begin_of(block), begin_of(block + 1), target);
    std::vector<Cluster> clusters = blocks_[block].roots;
    for (std::size_t i = 0; i < clusters.size(); ++i) {
      const auto place = static_cast<std::uint32_t>(block * kept_clusters + i);
      clusters[i].id = ClusterId::given(place);
      clusters[i].free_slot = place;
    }
    return clusters;
  }

  struct RootPlace {
    std::size_t block, root;
  };
  RootPlace root_place(ClusterId id) const { return {id.number() / kept_clusters, id.number() % kept_clusters}; }

  /// Appends the primitives of a leaf that is made of roots of blocks. Recursion is no deeper than a leaf has
  /// references.
  void collect(ClusterId id, std::vector<std::uint32_t>& references) const {
    if (id.is_given()) {
      const auto [b, root] = root_place(id);
      const Tree::Node& leaf = blocks_[b].nodes()[root];
      const auto primitives = blocks_[b].references().subspan(leaf.first, leaf.count);
      references.insert(references.end(), primitives.begin(), primitives.end());
    } else {
      collect(joins_[id.number()].left, references);
      collect(joins_[id.number()].right, references);
    }
  }

  /// The nodes above the blocks, the leaves that are made of roots of blocks, then block by block.
  void write(const Cluster& root) {
    LargeVector<Tree::Node> top(1);
    std::vector<std::uint32_t> loose;
    struct Subtree {
      std::size_t node;
      RootPlace place;
    };
    std::vector<Subtree> subtrees;
    top.front().bounds = root.bounds;
    SubtreeWriter(width_).write(
        joins_.data(), SubtreeWriter::NoGroups{}, root.id, 0, 0, top, [&](Tree::Node& node, ClusterId id) {
          if (id.is_given()) {
            const RootPlace place = root_place(id);
            if (!blocks_[place.block].roots[place.root].id.is_leaf()) {
              subtrees.push_back({static_cast<std::size_t>(&node - top.data()), place});
              return;
            }
          }
          node.leaf = 1;
          node.first = static_cast<std::uint32_t>(loose.size());
          collect(id, loose);
          node.count = (static_cast<std::uint32_t>(loose.size()) - node.first) & Tree::max_count;
        });

    std::vector<std::size_t> node_places{top.size()}, reference_places{loose.size()};
    for (const ClusterBlock& block : blocks_) {
      node_places.push_back(node_places.back() + block.nodes_below_roots());
      reference_places.push_back(reference_places.back() + block.reference_count - block.loose_references);
    }
    reserve_large(tree_.nodes, node_places.back());
    reserve_large(tree_.references, count_);
    tree_.nodes.resize(node_places.back());
    tree_.references.resize(count_);
    std::copy(top.begin(), top.end(), tree_.nodes.begin());
    std::copy(loose.begin(), loose.end(), tree_.references.begin());
    tbb::parallel_for(std::size_t{0}, blocks_.size(),
                      [&](std::size_t b) { place_block(blocks_[b], node_places[b], reference_places[b]); });
    for (const Subtree& subtree : subtrees) {
      const ClusterBlock& block = blocks_[subtree.place.block];
      tree_.nodes[subtree.node] = block.nodes()[subtree.place.root];
      tree_.nodes[subtree.node].first +=
          static_cast<std::uint32_t>(node_places[subtree.place.block] - block.roots.size());
    }
  }

  void place_block(const ClusterBlock& block, std::size_t node_place, std::size_t reference_place) {
    const auto node_shift = static_cast<std::uint32_t>(node_place - block.roots.size());
    const auto reference_shift = static_cast<std::uint32_t>(reference_place - block.loose_references);
    const auto below = block.nodes().subspan(block.roots.size());
    std::transform(below.begin(), below.end(), tree_.nodes.begin() + static_cast<std::ptrdiff_t>(node_place),
                   [=](Tree::Node node) {
                     node.first += node.is_leaf() ? reference_shift : node_shift;
                     return node;
                   });
    std::ranges::copy(block.references().subspan(block.loose_references),
                      tree_.references.begin() + static_cast<std::ptrdiff_t>(reference_place));
  }

  const MortonOrder& order_;
  std::uint32_t width_;
  std::size_t count_;
  Tree tree_;
  RawArray<ClusterNode> joins_;  ///< above the blocks, whose roots own kept_clusters places each
  std::vector<std::size_t> begins_;
  std::vector<ClusterBlock> blocks_;
  tbb::enumerable_thread_specific<BlockBuilder> builders_;
  tbb::enumerable_thread_specific<ClusterStack> stacks_;
};

}  // namespace

Tree cluster(std::span<const Reference> references, const MortonOrder& order, const ClusteringOptions& options) {
  if (references.empty()) return {};
  return Clustering(references, order, options).run();
}

}  // namespace boxwood
