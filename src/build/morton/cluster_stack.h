#pragma once
#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "build/morton/cluster_kernels.h"
#include "build/morton/cluster_tree.h"

namespace boxwood {

/// Clusters in the order of the curve, the last ones on top.
class ClusterStack {
 public:
  /// `most_reduced`: most clusters that one call of reduce() begins with.
  ClusterStack(std::size_t capacity, std::size_t most_reduced, const ClusteringOptions& options);

  std::size_t size() const { return size_; }
  void push(const Cluster& cluster) { set(size_++, cluster); }
  Cluster operator[](std::size_t i) const;
  void clear() { size_ = 0; }

  /// Joins the clusters from `begin` up until at most `target` (>= 1) are left, each with the neighbour along the curve
  /// whose union with it is smallest. The joins go to nodes[slot] of the slots that the clusters own.
  void reduce(std::size_t begin, std::size_t target, ClusterNode* nodes);

 private:
  void set(std::size_t i, const Cluster& cluster);
  std::size_t pair_neighbors(std::size_t count);
  Cluster join(const Cluster& left, const Cluster& right, ClusterNode* nodes) const;

  ClusteringOptions options_;
  std::size_t size_ = 0;
  std::array<std::vector<float>, ClusterPlanes::box_planes> boxes_;
  std::array<std::vector<std::uint32_t>, ClusterPlanes::fact_planes> facts_;
  // Scratch of one round.
  std::vector<std::int32_t> keys_, rows_, partners_, lower_, upper_;
};

}  // namespace boxwood
