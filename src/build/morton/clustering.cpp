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

  /// A part of the nodes above the blocks: the root of a subtree and what is below it, but no block.
  struct Piece {
    struct Block {
      std::size_t node;
      RootPlace root;
    };
    std::size_t place = 0;  ///< the root's in the tree, where the first piece's nodes have the places they have here
    LargeVector<Tree::Node> nodes = LargeVector<Tree::Node>(1);
    std::vector<std::uint32_t> references;  ///< of leaves that are made of roots of blocks
    std::vector<Block> blocks;              ///< whose roots belong to these nodes

    std::size_t nodes_below_root() const { return nodes.size() - 1; }
  };
  static constexpr std::size_t wanted_pieces = 128;

  /// What a piece does with a child that is no join.
  auto finish(Piece& piece) const {
    return [this, &piece](Tree::Node& node, ClusterId id) {
      if (id.is_given()) {
        const RootPlace place = root_place(id);
        if (!blocks_[place.block].roots[place.root].id.is_leaf()) {
          piece.blocks.push_back({static_cast<std::size_t>(&node - piece.nodes.data()), place});
          return;
        }
      }
      node.leaf = 1;
      node.first = static_cast<std::uint32_t>(piece.references.size());
      collect(id, piece.references);
      node.count = (static_cast<std::uint32_t>(piece.references.size()) - node.first) & Tree::max_count;
    };
  }

  /// First the nodes near the root, until there are subtrees enough for other tasks, then those.
  std::vector<Piece> write_pieces(const Cluster& root) {
    std::vector<Piece> pieces(1);
    Piece& top = pieces.front();
    top.nodes.front().bounds = root.bounds;
    if (!root.id.is_inner()) {
      finish(top)(top.nodes.front(), root.id);
      return pieces;
    }
    SubtreeWriter writer(width_);
    std::vector<SubtreeWriter::Pending> open{{root.id.number(), 0}};
    while (!open.empty() && open.size() < wanted_pieces) {
      std::vector<SubtreeWriter::Pending> next;
      for (const SubtreeWriter::Pending& at : open) {
        writer.write_one(joins_.data(), SubtreeWriter::NoGroups{}, at, 0, top.nodes, finish(top), next);
      }
      open = std::move(next);
    }
    pieces.resize(1 + open.size());
    tbb::parallel_for(std::size_t{0}, open.size(), [&](std::size_t i) {
      Piece& piece = pieces[1 + i];
      piece.place = open[i].node;
      piece.nodes.front().bounds = pieces.front().nodes[piece.place].bounds;
      SubtreeWriter(width_).write(joins_.data(), SubtreeWriter::NoGroups{}, ClusterId::inner(open[i].slot), 0, 0,
                                  piece.nodes, finish(piece));
    });
    return pieces;
  }

  /// The root, the pieces of the nodes above the blocks, then block by block.
  void write(const Cluster& root) {
    const std::vector<Piece> pieces = write_pieces(root);
    std::vector<std::size_t> node_places{1}, reference_places{0};
    const auto add = [&](std::size_t nodes, std::size_t references) {
      node_places.push_back(node_places.back() + nodes);
      reference_places.push_back(reference_places.back() + references);
    };
    for (const Piece& piece : pieces) add(piece.nodes_below_root(), piece.references.size());
    for (const ClusterBlock& block : blocks_) {
      add(block.nodes_below_roots(), block.reference_count - block.loose_references);
    }
    tree_.nodes = unwritten<Tree::Node>(node_places.back());
    tree_.references = unwritten<std::uint32_t>(count_);
    tbb::parallel_for(std::size_t{0}, pieces.size() + blocks_.size(), [&](std::size_t i) {
      if (i < pieces.size()) {
        place(pieces[i].nodes, 1, pieces[i].references, 0, node_places[i], reference_places[i]);
      } else {
        const ClusterBlock& block = blocks_[i - pieces.size()];
        place(block.nodes(), block.roots.size(), block.references(), block.loose_references, node_places[i],
              reference_places[i]);
      }
    });
    // Roots are children of other parts' nodes.
    for (std::size_t p = 0; p < pieces.size(); ++p) {
      const Piece& piece = pieces[p];
      tree_.nodes[piece.place] = shifted(piece.nodes.front(), node_places[p] - 1, reference_places[p]);
      for (const auto& [node, at] : piece.blocks) {
        const ClusterBlock& block = blocks_[at.block];
        tree_.nodes[node == 0 ? piece.place : node_places[p] + node - 1] =
            shifted(block.nodes()[at.root], node_places[pieces.size() + at.block] - block.roots.size(), 0);
      }
    }
  }

  static Tree::Node shifted(Tree::Node node, std::size_t nodes, std::size_t references) {
    node.first += static_cast<std::uint32_t>(node.is_leaf() ? references : nodes);
    return node;
  }

  /// Copies a part of the tree to its place, without the first nodes and references.
  void place(std::span<const Tree::Node> nodes, std::size_t first_node, std::span<const std::uint32_t> references,
             std::size_t first_reference, std::size_t node_place, std::size_t reference_place) {
    std::transform(nodes.begin() + static_cast<std::ptrdiff_t>(first_node), nodes.end(),
                   tree_.nodes.begin() + static_cast<std::ptrdiff_t>(node_place), [=](const Tree::Node& node) {
                     return shifted(node, node_place - first_node, reference_place - first_reference);
                   });
    std::ranges::copy(references.subspan(first_reference),
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
