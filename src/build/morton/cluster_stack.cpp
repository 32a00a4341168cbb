#include "build/morton/cluster_stack.h"

#include <algorithm>

namespace boxwood {

ClusterStack::ClusterStack(std::size_t capacity, std::size_t most_reduced, const ClusteringOptions& options,
                           ClusterTree& tree)
    : options_(options),
      tree_(tree),
      facts_(capacity),
      keys_(most_reduced + neighbor_padding),
      rows_(options.radius * (most_reduced + 2 * neighbor_padding)),
      partners_(most_reduced),
      survivors_(most_reduced),
      merged_(most_reduced) {
  for (auto& plane : planes_) plane.resize(capacity + neighbor_padding);
}

void ClusterStack::push(const Cluster& cluster) {
  set_box(size_, cluster.bounds);
  facts_[size_++] = cluster.facts;
}

Box ClusterStack::box(std::size_t i) const {
  return {{planes_[0][i], planes_[1][i], planes_[2][i]}, {planes_[3][i], planes_[4][i], planes_[5][i]}};
}

void ClusterStack::set_box(std::size_t i, const Box& box) {
  for (std::size_t axis = 0; axis < 3; ++axis) {
    planes_[axis][i] = box.lower[axis];
    planes_[axis + 3][i] = box.upper[axis];
  }
}

/// partners_[i] = the partner of cluster begin + i when both choose each other, else i itself.
void ClusterStack::choose_partners(std::size_t begin) {
  const std::size_t count = size_ - begin;
  ClusterBoxes boxes;
  for (int p = 0; p < 6; ++p) boxes.planes[p] = planes_[p].data() + begin;
  const std::uint32_t radius = std::min(options_.radius, static_cast<std::uint32_t>(count - 1));
  find_nearest(boxes, count, radius, keys_.data(), rows_.data());
  std::uint32_t agreed = 0;
  for (std::uint32_t i = 0; i < count; ++i) {
    const std::uint32_t partner = partner_of(i, keys_[i]);
    const bool mutual = partner_of(partner, keys_[partner]) == i;
    partners_[i] = mutual ? partner : i;
    agreed += mutual ? 1 : 0;
  }
  // Boxes nested in one another agree on one pair a round. Joining neighbours instead bounds rounds and depth.
  if (agreed * 16 < count) {
    for (std::uint32_t i = 0; i < count; ++i) partners_[i] = std::min(i ^ 1, static_cast<std::uint32_t>(count - 1));
  }
}

void ClusterStack::merge(std::size_t left, std::size_t right) {
  ClusterFacts& facts = facts_[left];
  const ClusterFacts& other = facts_[right];
  const Box bounds = unite(box(left), box(right));
  const float area = half_area(bounds);
  const std::uint32_t slot = facts.free_slot;
  tree_.nodes[slot] = {bounds, facts.id, other.id};

  const std::uint32_t references = facts.size.references + other.size.references;
  const std::uint32_t blocks = (references + options_.leaf_block - 1) / options_.leaf_block;
  const float leaf_cost = area * static_cast<float>(blocks);
  const float inner_cost = area + facts.cost + other.cost;
  const bool leaf = references <= options_.leaf_size && leaf_cost <= inner_cost;
  const std::uint32_t nodes = leaf ? 1 : 1 + facts.size.nodes + other.size.nodes;
  tree_.sizes[slot] = {references, nodes};

  facts = {{slot}, other.free_slot, {references, nodes}, leaf ? leaf_cost : inner_cost};
  set_box(left, bounds);
}

void ClusterStack::reduce(std::size_t begin, std::size_t target) {
  while (size_ - begin > target) {
    const std::size_t count = size_ - begin;
    choose_partners(begin);
    // Without branches on the choices, which nobody could predict: list who stays and who takes a partner in.
    std::size_t survivors = 0, merged = 0;
    for (std::uint32_t i = 0; i < count; ++i) {
      survivors_[survivors] = i;
      merged_[merged] = i;
      survivors += partners_[i] >= i ? 1 : 0;
      merged += partners_[i] > i ? 1 : 0;
    }
    for (std::size_t m = 0; m < merged; ++m) merge(begin + merged_[m], begin + partners_[merged_[m]]);
    for (auto& plane : planes_) {
      for (std::size_t i = 0; i < survivors; ++i) plane[begin + i] = plane[begin + survivors_[i]];
    }
    for (std::size_t i = 0; i < survivors; ++i) facts_[begin + i] = facts_[begin + survivors_[i]];
    size_ = begin + survivors;
  }
}

}  // namespace boxwood
