#pragma once
#include <cstddef>
#include <cstdint>
#include <vector>

#include "build/morton/clustering.h"
#include "build/morton/nearest_neighbors.h"

namespace boxwood {

/// What is known of a cluster besides its box.
struct ClusterFacts {
  ClusterId id;
  /// A cluster of m references owns m node slots and uses m - 1; this is the free one. Two clusters merge into the left
  /// one's free slot and keep the right one's: no counter is shared, and slots follow the curve.
  std::uint32_t free_slot = 0;
  ClusterTree::Size size;
  float cost = 0;  ///< surface area cost of the subtree, times area
};

struct Cluster {
  Box bounds;
  ClusterFacts facts;
};

/// Clusters in the order of the curve, the last ones on top. Boxes lie in six arrays for the search of neighbours.
class ClusterStack {
 public:
  ClusterStack(std::size_t capacity, std::size_t most_reduced, const ClusteringOptions& options, ClusterTree& tree);

  std::size_t size() const { return size_; }
  void push(const Cluster& cluster);
  Cluster operator[](std::size_t i) const { return {box(i), facts_[i]}; }
  void clear() { size_ = 0; }

  /// Merges the clusters from `begin` up until at most `target` (>= 1) are left.
  void reduce(std::size_t begin, std::size_t target);

 private:
  Box box(std::size_t i) const;
  void set_box(std::size_t i, const Box& box);
  void choose_partners(std::size_t begin);
  void merge(std::size_t left, std::size_t right);

  ClusteringOptions options_;
  ClusterTree& tree_;
  std::size_t size_ = 0;
  std::vector<float> planes_[6];
  std::vector<ClusterFacts> facts_;
  // Scratch of one round.
  std::vector<PairKey> keys_, rows_;
  std::vector<std::uint32_t> partners_, survivors_, merged_;
};

}  // namespace boxwood
