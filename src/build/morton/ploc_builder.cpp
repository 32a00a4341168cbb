// Bottom-up building in the order of the Morton curve: quick, and better than splitting along the curve. Meister and
// Bittner 2018, "Parallel Locally-Ordered Clustering"; Benthin et al. 2024, "H-PLOC".
#include <algorithm>

#include "boxwood/error.h"
#include "build/morton/clustering.h"
#include "build/morton/morton_order.h"
#include "build/morton/stages.h"
#include "build/spatial/presplit.h"

namespace boxwood {
namespace {

/// Times a reference's share of the scene's area from which a leaf is large. More than where trees are to be the best:
/// that costs the smaller trees of this builder no memory.
constexpr float large_leaf = 512;

struct PlocOptions {
  std::uint32_t radius = 8;
  std::uint32_t morton = 30;
  std::uint32_t leaf = 4;
  std::uint32_t block = 1;
  std::uint32_t run = 1;
  float slack = 1;
  std::uint32_t group = 1;
  std::uint32_t width = 2;
  float presplit = 0;
};

Tree build_ploc(const PlocOptions& options, BuildInput input) {
  // Boxes alone, of instances, cannot be cut.
  const bool cut = options.presplit > 0 && input.geometry;
  if (cut) input.references = presplit(std::move(input.references), *input.geometry, options.presplit);
  if (input.references.size() >= ClusterId::leaf_bit) {
    throw Error("'ploc' takes fewer than 2^30 primitives; split the scene into instances");
  }
  const MortonOrder order = morton_order(input.references, options.morton);
  const LargeLeaf large = options.block > 1 ? LargeLeaf(order.area, input.references.size(), large_leaf) : LargeLeaf();
  Tree tree = cluster(input.references, order,
                      {options.radius, options.leaf, options.block, std::min(options.run, options.leaf), options.slack,
                       std::min(options.group, options.width), options.width, large});
  tree.clipped_leaves = cut;
  return tree;
}

std::uint32_t ploc_arity(const PlocOptions& options) { return options.width; }

}  // namespace

Stage ploc_stage() {
  OptionsOf<PlocOptions> options;
  options
      .integer("radius", &PlocOptions::radius, 1, 31, "places along the curve in which a cluster looks for its partner")
      .integer("morton", &PlocOptions::morton, 3, 60, "bits of a Morton code, at most; fewer when a scene is large")
      .integer("leaf", &PlocOptions::leaf, 1, 64, "most references in a leaf, where that is cheaper")
      .integer("block", &PlocOptions::block, 1, 16, "references a leaf tests at the price of one")
      .integer("run", &PlocOptions::run, 1, 16,
               "references next to each other on the curve that become a leaf before clustering, where that is cheaper")
      .real("slack", &PlocOptions::slack, 0, 4, "how much dearer than apart the references of such a leaf may be")
      .integer(
          "group", &PlocOptions::group, 1, max_cluster_width,
          "such leaves next to each other that become a node before clustering, where that is cheaper; at most 'width'")
      .integer("width", &PlocOptions::width, 2, max_cluster_width,
               "most children of a node; those of more than two are made as 'collapse' would, without the binary tree")
      .real("presplit", &PlocOptions::presplit, 0, 4,
            "references that cutting long triangles may add, as a part of all");
  return builder_stage<PlocOptions>("ploc", "joins neighbours along the Morton curve, bottom-up",
                                    "Meister and Bittner 2018; Benthin et al. 2024", options, build_ploc, ploc_arity);
}

}  // namespace boxwood
