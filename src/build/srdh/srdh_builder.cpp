// Trees for rays that any hit ends: splits and the order of children are chosen for what representative rays would be
// ended by. Feltman, Lee, Fatahalian 2012, "SRDH: Specializing BVH Construction and Traversal Order Using
// Representative Shadow Ray Sets"; SAH alternatives study, section 2.13.
#include <algorithm>

#include "boxwood/error.h"
#include "build/binned_cuts.h"
#include "build/srdh/shadow_split.h"
#include "build/srdh/stages.h"

namespace boxwood {
namespace {

struct SrdhOptions {
  std::uint32_t bins = 16;
  std::uint32_t leaf = 4;
};

class SrdhBuilder {
 public:
  SrdhBuilder(const SrdhOptions& options, BuildInput& input, const Centroids& centroids, const SegmentHits& lists)
      : options_(options), references_(input.references), centroids_(centroids), lists_(lists) {
    for (const Reference& reference : references_) {
      if (centers2_.size() <= reference.primitive) centers2_.resize(reference.primitive + std::size_t{1});
      const Float4 c = centroids(reference);
      centers2_[reference.primitive] = {c[0], c[1], c[2]};
    }
  }

  Tree run() {
    NodeRays rays;
    for (std::uint32_t i = 0; i < lists_.rays.size(); ++i) {
      const auto first = static_cast<std::uint32_t>(rays.hits.size());
      const std::span<const std::uint32_t> hits = lists_.of(i);
      rays.entries.push_back({i, first, static_cast<std::uint32_t>(hits.size())});
      rays.hits.insert(rays.hits.end(), hits.begin(), hits.end());
    }
    tree_.nodes.emplace_back();
    write(references_, std::move(rays), 0, 0);
    return std::move(tree_);
  }

 private:
  static constexpr std::uint32_t last_free_level = 64;  // below, halves by count: no input makes a deep tree

  /// Sets nodes[place] and appends all below it.
  void write(std::span<Reference> references, NodeRays rays, std::uint32_t level, std::size_t place) {
    Box4 bounds, centers;
    for (const Reference& reference : references) {
      bounds.grow(box4(reference));
      centers.grow(centroids_(reference));
    }
    Tree::Node node;
    node.bounds = bounds.box();
    if (references.size() <= options_.leaf) {
      node.leaf = 1;
      node.first = static_cast<std::uint32_t>(tree_.references.size());
      node.count = static_cast<std::uint32_t>(references.size()) & Tree::max_count;
      for (const Reference& reference : references) tree_.references.push_back(reference.primitive);
      tree_.nodes[place] = node;
      return;
    }
    const ReferenceSet set{references, bounds, centers};
    ShadowSplit split;
    if (level < last_free_level) {
      split = find_shadow_split(set, centroids_, centers2_, lists_, rays, options_.bins);
    }
    const std::size_t first = tree_.nodes.size();
    node.first = static_cast<std::uint32_t>(first);
    node.count = 2;
    node.axis = split.right_first || !split.found() ? Tree::mixed_axis : static_cast<std::uint32_t>(split.axis) & 3;
    node.fixed_order = !rays.entries.empty() && split.found() ? 1 : 0;
    tree_.nodes[place] = node;
    tree_.nodes.resize(first + 2);

    const std::size_t left = divide(references, split);
    NodeRays left_rays, right_rays;
    if (split.found()) share(rays, split, left_rays, right_rays);
    rays = {};
    // The side that is visited first is stored first.
    const std::size_t left_place = first + (split.right_first ? 1 : 0),
                      right_place = first + (split.right_first ? 0 : 1);
    write(references.first(left), std::move(left_rays), level + 1, left_place);
    write(references.subspan(left), std::move(right_rays), level + 1, right_place);
  }

  std::size_t divide(std::span<Reference> references, const ShadowSplit& split) const {
    if (!split.found()) return references.size() / 2;
    return partition(references, [&](const Reference& reference) {
      return split.mapping(centroids_(reference), split.axis) < split.border;
    });
  }

  /// Sends rays to the sides they visit: those whose box they meet, unless the side before ended them.
  void share(const NodeRays& rays, const ShadowSplit& split, NodeRays& left, NodeRays& right) const {
    for (const NodeRays::Entry& entry : rays.entries) {
      std::vector<std::uint32_t> left_hits, right_hits;
      for (const std::uint32_t primitive : rays.hits_of(entry)) {
        const auto& c = centers2_[primitive];
        const bool is_left = split.mapping(Float4{c[0], c[1], c[2], 0}, split.axis) < split.border;
        (is_left ? left_hits : right_hits).push_back(primitive);
      }
      const bool ended_left = !left_hits.empty(), ended_right = !right_hits.empty();
      const Segment& ray = lists_.rays[entry.ray];
      if (ray.meets(split.left) && !(split.right_first && ended_right)) add(left, entry.ray, left_hits);
      if (ray.meets(split.right) && !(!split.right_first && ended_left)) add(right, entry.ray, right_hits);
    }
  }

  static void add(NodeRays& rays, std::uint32_t ray, const std::vector<std::uint32_t>& hits) {
    const auto first = static_cast<std::uint32_t>(rays.hits.size());
    rays.entries.push_back({ray, first, static_cast<std::uint32_t>(hits.size())});
    rays.hits.insert(rays.hits.end(), hits.begin(), hits.end());
  }

  SrdhOptions options_;
  std::span<Reference> references_;
  const Centroids& centroids_;
  const SegmentHits& lists_;
  CentersByPrimitive centers2_;
  Tree tree_;
};

Tree greedy_tree(BuildInput input, const Centroids& centroids) {
  const CostOptions greedy;
  return build_top_down(std::move(input), centroids, greedy.leaf,
                        [&](const ReferenceSet& set) { return sweep(set, centroids, greedy, SurfaceAreaPricing{}); });
}

Tree build_srdh(const SrdhOptions& options, BuildInput input) {
  if (!input.use) {
    throw UsageError("'srdh' must know which rays will be traced and was told nothing; set BuildOptions::use");
  }
  if (input.references.empty()) return {};
  const Centroids centroids(input, CentroidKind::box);
  // Instances have no triangles of their own: they are put in a tree by surface area.
  if (!input.geometry) return greedy_tree(std::move(input), centroids);
  const SegmentHits lists = hit_lists(greedy_tree(input, centroids), *input.geometry, *input.use);
  return SrdhBuilder(options, input, centroids, lists).run();
}

}  // namespace

Stage srdh_stage() {
  OptionsOf<SrdhOptions> options;
  options.integer("bins", &SrdhOptions::bins, 2, max_bins, "bins per axis")
      .integer("leaf", &SrdhOptions::leaf, 1, largest_leaf, "references that make a leaf");
  Stage stage =
      builder_stage<SrdhOptions>("srdh", "splits and orders for rays that any hit ends, by representative ones",
                                 "Feltman, Lee, Fatahalian 2012; SAH alternatives study", options, build_srdh,
                                 [](const SrdhOptions&) { return 2u; });
  stage.needs_use = [](const std::any&) { return true; };
  return stage;
}

}  // namespace boxwood
