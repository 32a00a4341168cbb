#include "build/morton/cluster_stack.h"

#include <algorithm>
#include <bit>

namespace boxwood {
namespace {

enum Fact : std::size_t { id, free_slot, leaf_references, cost };

}  // namespace

ClusterStack::ClusterStack(std::size_t capacity, std::size_t most_reduced, const ClusteringOptions& options)
    : options_(options) {
  for (auto& plane : boxes_) plane.resize(capacity + cluster_padding);
  for (auto& plane : facts_) plane.resize(capacity + cluster_padding);
  for (auto* list : {&keys_, &partners_, &lower_, &upper_}) list->resize(most_reduced + cluster_padding);
  rows_.resize(options.radius * (most_reduced + 2 * cluster_padding));
}

Cluster ClusterStack::operator[](std::size_t i) const {
  return {{{boxes_[0][i], boxes_[1][i], boxes_[2][i]}, {boxes_[3][i], boxes_[4][i], boxes_[5][i]}},
          {facts_[Fact::id][i]},
          facts_[Fact::free_slot][i],
          facts_[Fact::leaf_references][i],
          std::bit_cast<float>(facts_[Fact::cost][i])};
}

void ClusterStack::set(std::size_t i, const Cluster& cluster) {
  for (std::size_t axis = 0; axis < 3; ++axis) {
    boxes_[axis][i] = cluster.bounds.lower[axis];
    boxes_[axis + 3][i] = cluster.bounds.upper[axis];
  }
  facts_[Fact::id][i] = cluster.id.bits;
  facts_[Fact::free_slot][i] = cluster.free_slot;
  facts_[Fact::leaf_references][i] = cluster.leaf_references;
  facts_[Fact::cost][i] = std::bit_cast<std::uint32_t>(cluster.cost);
}

Cluster ClusterStack::join(const Cluster& left, const Cluster& right, ClusterNode* nodes) const {
  const Box bounds = unite(left.bounds, right.bounds);
  const Vec3 extent = bounds.extent();
  const float area = extent.x * (extent.y + extent.z) + extent.y * extent.z;
  const std::uint32_t slot = left.free_slot;
  nodes[slot] = {left.bounds, right.bounds, left.id, right.id};

  const float inner_cost = area + left.cost + right.cost;
  // A leaf is made of leaves: what was better apart seldom is better together.
  const std::uint32_t references = left.leaf_references + right.leaf_references;
  if (left.leaf_references > 0 && right.leaf_references > 0 && references <= options_.leaf_size) {
    const std::uint32_t blocks = (references + options_.leaf_block - 1) / options_.leaf_block;
    const float leaf_cost = area * static_cast<float>(blocks);
    const bool in_halves = blocks == 1 && options_.large_leaf.is_better_in_halves(area, left.cost + right.cost);
    if (leaf_cost <= inner_cost && !in_halves) {
      return {bounds, ClusterId::node(slot, true), right.free_slot, references, leaf_cost};
    }
  }
  return {bounds, ClusterId::node(slot, false), right.free_slot, 0, inner_cost};
}

/// Pairs each even place with the next one.
std::size_t ClusterStack::pair_neighbors(std::size_t count) {
  const std::size_t pairs = count / 2;
  partners_[count - 1] = static_cast<std::int32_t>(count - 1);
  for (std::size_t p = 0; p < pairs; ++p) {
    partners_[2 * p + 1] = lower_[p] = static_cast<std::int32_t>(2 * p);
    partners_[2 * p] = upper_[p] = static_cast<std::int32_t>(2 * p + 1);
  }
  return pairs;
}

void ClusterStack::reduce(std::size_t begin, std::size_t target, ClusterNode* nodes) {
  while (size_ - begin > target) {
    const std::size_t count = size_ - begin;
    ClusterPlanes planes;
    for (std::size_t p = 0; p < boxes_.size(); ++p) planes.boxes[p] = boxes_[p].data() + begin;
    for (std::size_t p = 0; p < facts_.size(); ++p) planes.facts[p] = facts_[p].data() + begin;
    const std::uint32_t radius = std::min(options_.radius, static_cast<std::uint32_t>(count - 1));
    std::size_t pairs = find_pairs(planes, count, radius, {keys_.data(), rows_.data(), partners_.data()},
                                   {lower_.data(), upper_.data()});
    // Boxes nested in one another agree on one pair a round. Joining neighbours instead bounds rounds and depth.
    if (pairs * 32 < count) pairs = pair_neighbors(count);
    for (std::size_t p = 0; p < pairs; ++p) {
      const std::size_t lower = begin + static_cast<std::size_t>(lower_[p]);
      set(lower, join((*this)[lower], (*this)[begin + static_cast<std::size_t>(upper_[p])], nodes));
    }
    size_ = begin + remove_joined(planes, count, partners_.data());
  }
}

}  // namespace boxwood
