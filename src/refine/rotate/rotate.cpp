// Tree rotations, greedy or annealed: exchanges a child with a grandchild, or two grandchildren, where that makes boxes
// smaller. Kensler 2008, "Tree Rotations for Improving Bounding Volume Hierarchies".
#include <array>
#include <cmath>
#include <utility>

#include "math/random.h"
#include "refine/reinsert/link_tree.h"
#include "refine/rotate/stages.h"
#include "tree/statistics.h"

namespace boxwood {
namespace {

struct RotateOptions {
  std::uint32_t rounds = 8;
  float temperature = 0;
  std::uint32_t seed = 1;
};

constexpr std::uint32_t deepest = 100;  // what kernels are sure to have a stack for

/// Two places whose subtrees change places, and by how much the areas of inner nodes shrink.
struct Rotation {
  Edge a = LinkTree::no_edge, b = LinkTree::no_edge;
  float gain = 0;
};

class Rotator {
 public:
  explicit Rotator(LinkTree& tree) : tree_(tree) {}

  /// One pass over all nodes from the last to the first; of a fresh LinkTree, from the bottom to the top. At
  /// temperature 0 the best rotation of each node is made when it gains something; above, one at random, with the
  /// probability that the Metropolis rule gives it. Returns the gain.
  double pass(double temperature, Random& random) {
    double gain = 0;
    for (std::uint32_t n = static_cast<std::uint32_t>(tree_.inner.size()); n-- > 0;) {
      const Rotation rotation = temperature > 0 ? any_rotation(n, random) : best_rotation(n);
      if (rotation.a == LinkTree::no_edge) continue;
      const bool accept =
          rotation.gain > 0 || (temperature > 0 && double{random.uniform()} < std::exp(rotation.gain / temperature));
      if (!accept) continue;
      apply(rotation);
      gain += double{rotation.gain};
    }
    return gain;
  }

 private:
  /// Calls with every rotation at a node: at most six.
  template <class Call>
  void each_rotation(std::uint32_t node, const Call& call) const {
    const Edge children[2] = {2 * node, 2 * node + 1};
    for (std::size_t side = 0; side < 2; ++side) {
      const Edge child = children[side], other = children[1 - side];
      if (tree_.child(other).is_leaf()) continue;
      const Edge below = 2 * tree_.child(other).number();
      for (const Edge grandchild : {below, below + 1}) {
        const Box rest = unite(tree_.bounds(child), tree_.bounds(LinkTree::sibling(grandchild)));
        call(Rotation{child, grandchild, half_area(tree_.bounds(other)) - half_area(rest)});
      }
    }
    if (tree_.child(children[0]).is_leaf() || tree_.child(children[1]).is_leaf()) return;
    const Edge a = 2 * tree_.child(children[0]).number(), b = 2 * tree_.child(children[1]).number();
    const float before = half_area(tree_.bounds(children[0])) + half_area(tree_.bounds(children[1]));
    for (const Edge other : {b, b + 1}) {
      const float after = half_area(unite(tree_.bounds(other), tree_.bounds(a + 1))) +
                          half_area(unite(tree_.bounds(a), tree_.bounds(LinkTree::sibling(other))));
      call(Rotation{a, other, before - after});
    }
  }

  Rotation best_rotation(std::uint32_t node) const {
    Rotation best;
    each_rotation(node, [&](const Rotation& rotation) {
      if (rotation.gain > best.gain) best = rotation;
    });
    return best;
  }

  Rotation any_rotation(std::uint32_t node, Random& random) const {
    std::array<Rotation, 6> all;
    std::uint32_t count = 0;
    each_rotation(node, [&](const Rotation& rotation) { all[count++] = rotation; });
    return count == 0 ? Rotation{} : all[random.below(count)];
  }

  void apply(const Rotation& rotation) {
    LinkTree::Inner &a = tree_.parent(rotation.a), &b = tree_.parent(rotation.b);
    std::swap(a.children[rotation.a & 1], b.children[rotation.b & 1]);
    std::swap(a.bounds[rotation.a & 1], b.bounds[rotation.b & 1]);
    for (const Edge edge : {rotation.a, rotation.b}) {
      if (!tree_.child(edge).is_leaf()) tree_.inner[tree_.child(edge).number()].up = edge;
    }
    // The parents of both, where they lie below the node that was rotated.
    const bool same_level = tree_.parent(rotation.a).up != LinkTree::no_edge &&
                            tree_.parent(rotation.b).up != LinkTree::no_edge &&
                            tree_.parent(rotation.a).up >> 1 == tree_.parent(rotation.b).up >> 1;
    refit(rotation.b);
    if (same_level) refit(rotation.a);
  }

  /// Sets the box of the inner node that `edge` hangs from.
  void refit(Edge edge) {
    const LinkTree::Inner& node = tree_.parent(edge);
    tree_.parent(node.up).bounds[node.up & 1] = unite(node.bounds[0], node.bounds[1]);
  }

  LinkTree& tree_;
};

double mean_area(const LinkTree& tree) {
  double sum = 0;
  for (const LinkTree::Inner& node : tree.inner)
    sum += double{half_area(node.bounds[0])} + double{half_area(node.bounds[1])};
  return sum / (2 * static_cast<double>(tree.inner.size()));
}

Tree rotate(const RotateOptions& options, Tree tree) {
  if (tree.nodes.size() < 4) return tree;  // Fewer than three leaves: there is one tree only.
  const LinkTree start = link(tree);
  LinkTree links = start, best = start;
  Rotator rotator(links);
  Random random(options.seed);
  const double hot = double{options.temperature} * mean_area(links);
  double gain = 0, most = 0;
  for (std::uint32_t round = 0; round < options.rounds; ++round) {
    // Cools down to nothing in the last quarter.
    const double left = std::max(0.0, 1 - static_cast<double>(round + 1) / (0.75 * options.rounds));
    const double gained = rotator.pass(hot * left * left, random);
    gain += gained;
    if (gain > most) best = links, most = gain;
    if (hot * left == 0 && !(gained > 0)) break;
  }
  Tree rotated = relink(best, tree);
  return statistics(rotated).max_depth <= deepest ? rotated : relink(start, tree);
}

}  // namespace

Stage rotate_stage() {
  OptionsOf<RotateOptions> options;
  options.integer("rounds", &RotateOptions::rounds, 1, 10000, "passes over the tree, or until nothing gains")
      .real("temperature", &RotateOptions::temperature, 0, 1e6f,
            "of annealing, in mean node areas; falls to 0; 0: only what gains")
      .integer("seed", &RotateOptions::seed, 0, 0xffffffffu, "of annealing");
  return refinement_stage<RotateOptions>("rotate", "exchanges children with grandchildren; annealed if asked",
                                         "Kensler 2008", options, rotate, [](const RotateOptions&) { return 2u; });
}

}  // namespace boxwood
