#pragma once
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "build/build_input.h"
#include "build/float4.h"
#include "build/morton/cluster_stack.h"
#include "build/morton/morton_order.h"
#include "build/morton/subtree_writer.h"
#include "math/large_memory.h"
#include "tree/tree.h"

namespace boxwood {

/// Clusters that a part of the curve hands up to the part around it. More make a better tree for the same work, as long
/// as twice as many fit in the first-level cache.
inline constexpr std::size_t kept_clusters = 64;

/// A part of the curve, joined as far as it goes and written out while it is still in the cache.
struct ClusterBlock {
  std::vector<Cluster> roots;
  /// First the roots, then what is below them. Inner nodes count places from the block's first node, leaves from its
  /// first reference.
  std::span<const Tree::Node> nodes() const { return std::span(*all_nodes).subspan(first_node, node_count); }
  /// Primitives: first those of roots that are leaves, which may still join into larger leaves, then the others.
  std::span<const std::uint32_t> references() const {
    return std::span(*all_references).subspan(first_reference, reference_count);
  }
  std::size_t nodes_below_roots() const { return node_count - roots.size(); }

  const LargeVector<Tree::Node>* all_nodes = nullptr;
  const LargeVector<std::uint32_t>* all_references = nullptr;
  std::size_t first_node = 0, node_count = 0, first_reference = 0, reference_count = 0;
  std::size_t loose_references = 0;  ///< how many belong to roots that are leaves
};

/// Makes blocks, one after the other, and holds what they point to. One per thread.
class BlockBuilder {
 public:
  /// References in one block, at most: their joins (128 KiB) and boxes fit in the second-level cache.
  static constexpr std::size_t block_size = 2048;

  BlockBuilder(std::span<const Reference> references, const MortonOrder& order, const ClusteringOptions& options);

  /// Joins the references at [begin, end) along the curve into at most `target` clusters.
  ClusterBlock build(std::size_t begin, std::size_t end, std::size_t target);

 private:
  /// References next to each other on the curve that are one leaf from the start.
  struct Run {
    Box bounds;
    std::uint32_t place = 0;  ///< of the first
    std::uint32_t references = 0;
    float cost = 0;
  };
  /// Runs next to each other that are one node from the start.
  struct Group {
    Box4 bounds;
    std::uint32_t place = 0;  ///< of the first run
    std::uint32_t runs = 0;
    float area = 0, cost = 0;  ///< cost: of the runs
  };
  /// What the writer asks about groups.
  struct Groups {
    const BlockBuilder& builder;

    std::uint32_t size(ClusterId id) const { return builder.groups_[id.number()]; }
    void open(ClusterId id, SubtreeWriter::Child* children) const;
  };
  struct OpenGroup {
    std::size_t node;
    std::uint32_t place;
  };

  void push_references(std::size_t begin, std::size_t end);
  void add_run(const Run& run, const Box4& bounds, Group& group);
  void push(const Group& group);
  void join(std::size_t begin, std::size_t end, std::size_t target);
  void write(ClusterBlock& block);
  void write_root(std::size_t root, ClusterId id);
  void write_references(ClusterId id);
  void write_group(const OpenGroup& group);

  std::span<const Reference> references_;
  const MortonOrder& order_;
  ClusteringOptions options_;
  float slack_of_large_;  ///< `slack` of leaves that are large
  ClusterStack stack_;
  std::vector<std::uint32_t> primitives_;  ///< of the references, by place
  std::vector<Run> runs_;                  ///< by the place of their first reference
  std::vector<std::uint32_t> groups_;      ///< runs of each group, by the place of its first reference
  std::vector<OpenGroup> open_groups_;     ///< that have no children yet
  std::vector<ClusterNode> joins_;
  SubtreeWriter writer_;
  LargeVector<Tree::Node> written_nodes_;  ///< of all blocks
  LargeVector<std::uint32_t> written_references_;
  std::size_t block_begin_ = 0, first_node_ = 0, first_reference_ = 0;
};

}  // namespace boxwood
