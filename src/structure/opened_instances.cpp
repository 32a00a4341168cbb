#include "structure/opened_instances.h"

#include <algorithm>
#include <queue>
#include <utility>

#include "structure/mesh_geometry.h"
#include "structure/pipeline.h"

namespace boxwood {
namespace {

/// Of a mesh, how many instances tell what opening it gains.
constexpr std::size_t most_samples = 32;
/// Parts of fewer triangles cost more to enter than they save.
constexpr std::uint32_t least_in_part = 64;

/// How many references are below each node.
std::vector<std::uint32_t> sizes_of(const Tree& tree) {
  std::vector<std::uint32_t> sizes(tree.nodes.size());
  for (std::size_t i = tree.nodes.size(); i-- > 0;) {
    const Tree::Node& node = tree.nodes[i];
    if (node.is_leaf()) {
      sizes[i] = node.count;
    } else {
      for (std::uint32_t c = 0; c < node.count; ++c) sizes[i] += sizes[node.first + c];
    }
  }
  return sizes;
}

/// The tree below a node, its nodes in the order that they have: layouts follow it.
Tree subtree(const Tree& tree, std::uint32_t root) {
  std::vector<std::uint32_t> kept = {root};
  for (std::size_t i = 0; i < kept.size(); ++i) {
    const Tree::Node& node = tree.nodes[kept[i]];
    for (std::uint32_t c = 0; c < node.count && !node.is_leaf(); ++c) kept.push_back(node.first + c);
  }
  std::ranges::sort(kept);
  Tree out;
  out.clipped_leaves = tree.clipped_leaves;
  for (const std::uint32_t old : kept) {
    Tree::Node node = tree.nodes[old];
    const std::uint32_t first = node.first;
    if (node.is_leaf()) {
      node.first = static_cast<std::uint32_t>(out.references.size());
      out.references.insert(out.references.end(), tree.references.begin() + first,
                            tree.references.begin() + first + node.count);
    } else {
      node.first = static_cast<std::uint32_t>(std::ranges::lower_bound(kept, first) - kept.begin());
    }
    out.nodes.push_back(node);
  }
  return out;
}

/// World boxes of instances; empty where there is nothing.
std::vector<Box> boxes_of(const Scene& scene, const std::vector<Tree>& trees) {
  std::vector<Box> boxes;
  for (const Instance& instance : scene.instances) {
    const Tree& tree = trees[instance.mesh];
    boxes.push_back(tree.empty() ? Box{} : instance.object_to_world.box(tree.nodes[0].bounds));
  }
  return boxes;
}

/// Finds the instances that overlap a box.
class Overlaps {
 public:
  Overlaps(const Scene& scene, const std::vector<Tree>& trees)
      : boxes_(boxes_of(scene, trees)),
        tree_(Pipeline(Recipe::parse("binned > binary")).tree({instance_references(boxes_), nullptr, nullptr})) {}

  /// The areas of what `box` shares with each of the boxes but `own`, added up. Stops counting at the first thousand.
  float shared_area(const Box& box, std::uint32_t own) const {
    constexpr int enough = 1000;
    std::vector<std::uint32_t> open;
    if (!tree_.empty()) open.push_back(0);
    float sum = 0;
    for (int found = 0; !open.empty() && found < enough;) {
      const Tree::Node& node = tree_.nodes[open.back()];
      open.pop_back();
      if (intersect(node.bounds, box).empty()) continue;
      for (std::uint32_t n = 0; n < node.count; ++n) {
        if (!node.is_leaf()) {
          open.push_back(node.first + n);
        } else if (const std::uint32_t other = tree_.references[node.first + n]; other != own) {
          const float area = half_area(intersect(boxes_[other], box));
          sum += area;
          found += area > 0 ? 1 : 0;
        }
      }
    }
    return sum;
  }

 private:
  std::vector<Box> boxes_;
  Tree tree_;
};

/// A node of a mesh's tree that stands for what is below it.
struct Candidate {
  float gain;  ///< mean area that other instances share with it
  std::uint32_t mesh, node;
  bool operator<(const Candidate& other) const { return std::pair(gain, ~mesh) < std::pair(other.gain, ~other.mesh); }
};

class Opening {
 public:
  Opening(const Scene& scene, std::vector<Tree> trees)
      : scene_(scene), trees_(std::move(trees)), instances_of_(trees_.size()), cut_(trees_.size()) {
    for (std::uint32_t i = 0; i < scene.instances.size(); ++i) {
      const std::uint32_t mesh = scene.instances[i].mesh;
      if (!trees_[mesh].empty()) instances_of_[mesh].push_back(i);
    }
  }

  void keep_whole() {
    for (std::uint32_t mesh = 0; mesh < trees_.size(); ++mesh) {
      if (!trees_[mesh].empty()) cut_[mesh] = {0};
    }
  }

  void open(float references_per_instance) {
    const Overlaps overlaps(scene_, trees_);
    std::vector<std::vector<std::uint32_t>> sizes;
    for (const Tree& tree : trees_) sizes.push_back(sizes_of(tree));
    std::priority_queue<Candidate> queue;
    double left = 0;
    const auto add = [&](std::uint32_t mesh, std::uint32_t node) {
      const Tree::Node& to = trees_[mesh].nodes[node];
      // What stands once, such as the ground, overlaps everything, and would be divided first and most for nothing.
      const bool whole = to.is_leaf() || sizes[mesh][node] < least_in_part || instances_of_[mesh].size() == 1;
      const float gain = whole ? 0 : shared_area(overlaps, mesh, to.bounds);
      if (gain > 0) {
        queue.push({gain, mesh, node});
      } else {
        cut_[mesh].push_back(node);
      }
    };
    for (std::uint32_t mesh = 0; mesh < trees_.size(); ++mesh) {
      left += static_cast<double>(references_per_instance - 1) * static_cast<double>(instances_of_[mesh].size());
      if (!instances_of_[mesh].empty()) add(mesh, 0);
    }
    while (!queue.empty()) {
      const Candidate best = queue.top();
      queue.pop();
      const Tree::Node& node = trees_[best.mesh].nodes[best.node];
      const double cost = static_cast<double>(node.count - 1) * static_cast<double>(instances_of_[best.mesh].size());
      if (cost > left) {
        cut_[best.mesh].push_back(best.node);
        continue;
      }
      left -= cost;
      for (std::uint32_t c = 0; c < node.count; ++c) add(best.mesh, node.first + c);
    }
  }

  OpenedInstances result() {
    OpenedInstances out;
    std::vector<std::uint32_t> first_part;
    for (std::uint32_t mesh = 0; mesh < trees_.size(); ++mesh) {
      first_part.push_back(static_cast<std::uint32_t>(out.parts.size()));
      std::ranges::sort(cut_[mesh]);
      for (const std::uint32_t node : cut_[mesh]) {
        out.parts.push_back(node == 0 ? std::move(trees_[mesh]) : subtree(trees_[mesh], node));
        out.mesh_of.push_back(mesh);
      }
    }
    for (std::uint32_t i = 0; i < scene_.instances.size(); ++i) {
      Instance placed = scene_.instances[i];
      const std::uint32_t first = first_part[placed.mesh];
      const auto count = static_cast<std::uint32_t>(cut_[placed.mesh].size());
      for (placed.mesh = first; placed.mesh < first + count; ++placed.mesh) {
        out.instances.push_back(placed);
        out.numbers.push_back(i);
        out.boxes.push_back(placed.object_to_world.box(out.parts[placed.mesh].nodes[0].bounds));
      }
    }
    return out;
  }

 private:
  /// Mean over some of the mesh's instances.
  float shared_area(const Overlaps& overlaps, std::uint32_t mesh, const Box& part) const {
    const std::vector<std::uint32_t>& instances = instances_of_[mesh];
    const std::size_t samples = std::min(most_samples, instances.size());
    float sum = 0;
    for (std::size_t n = 0; n < samples; ++n) {
      const std::uint32_t i = instances[n * instances.size() / samples];
      sum += overlaps.shared_area(scene_.instances[i].object_to_world.box(part), i);
    }
    return sum / static_cast<float>(samples);
  }

  const Scene& scene_;
  std::vector<Tree> trees_;
  std::vector<std::vector<std::uint32_t>> instances_of_;  ///< of each mesh
  std::vector<std::vector<std::uint32_t>> cut_;           ///< of each mesh, the nodes that become parts
};

}  // namespace

OpenedInstances open_instances(const Scene& scene, std::vector<Tree> trees, float references_per_instance) {
  Opening opening(scene, std::move(trees));
  if (references_per_instance > 1) {
    opening.open(references_per_instance);
  } else {
    opening.keep_whole();
  }
  return opening.result();
}

}  // namespace boxwood
