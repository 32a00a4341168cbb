// Cells halved along all three axes until few primitives are left or dividing them does not pay: spec 004, section 2.2.
// The termination by surface area is our own; see docs/octrees.md.
#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include <array>
#include <atomic>
#include <numeric>

#include "boxwood/error.h"
#include "build/octree/deciders.h"
#include "build/octree/stages.h"
#include "build/octree/subtree.h"

namespace boxwood {
namespace {

constexpr std::size_t task_size = 1 << 12;  // cells with more references build their octants in parallel
/// Divisions on one path that do not pay by themselves but may pay further down.
constexpr std::uint32_t speculation_limit = 2;
constexpr std::uint64_t spare_references = 1 << 12;  // small scenes need not mind the budget

/// What a subtree costs a ray that enters its cell, in primitive tests, and how many references it holds.
struct Grown {
  double cost = 0;
  std::uint64_t references = 0;
};

struct Cell {
  OctreeCell place = OctreeCell::root();
  OctreeCode code = octree_root;
  std::uint32_t speculations = 0;  ///< divisions above it that may yet be undone

  Cell child(std::uint32_t octant, std::uint32_t speculative) const {
    return {place.child(octant), octree_child(code, octant), speculations + speculative};
  }
};

/// References of the cells on a path, level by level: a serial build allocates no more than once per level.
struct Path {
  struct Level {
    std::vector<std::uint32_t> set;
    std::vector<std::uint8_t> masks;
  };
  std::array<Level, octree_levels + 1> levels;
};

void append_octant(const OctreeSplit& split, std::uint32_t octant, std::vector<std::uint32_t>& part) {
  for (std::size_t i = 0; i < split.set.size(); ++i) {
    if (split.octants.masks[i] >> octant & 1) part.push_back(split.set[i]);
  }
}

class OctreeBuilder {
 public:
  OctreeBuilder(const OctreeOptions& options, BuildInput input)
      : options_(options),
        geometry_(input.geometry),
        references_(std::move(input.references)),
        grid_(octree_grid(bounds_of(references_))),
        finder_(references_, grid_, options.exact ? geometry_ : nullptr),
        limit_(static_cast<std::uint64_t>(double{options.budget} * static_cast<double>(references_.size())) +
               spare_references) {}

  Tree run() {
    std::vector<std::uint32_t> all(references_.size());
    std::iota(all.begin(), all.end(), 0u);
    OctreeSubtree whole;
    whole.add_siblings(1);
    grow(all, Cell{}, whole);
    Tree tree;
    tree.nodes = std::move(whole.nodes);
    tree.references = std::move(whole.references);
    tree.clipped_leaves = true;
    tree.cells = {grid_, std::move(whole.codes)};
    return tree;
  }

 private:
  static Box bounds_of(const LargeVector<Reference>& references) {
    Box bounds;
    for (const Reference& reference : references) bounds.grow(reference.box());
    return bounds;
  }

  /// Builds `out`, whose root is there already, over any set; large ones with a task for each octant.
  Grown grow(std::span<const std::uint32_t> set, const Cell& cell, OctreeSubtree& out) {
    if (set.size() <= task_size) {
      Path path;
      return grow_small(set, cell, path, out, 0);
    }
    if (!may_divide(set, cell)) return make_leaf(set, cell, out, 0);
    std::vector<std::uint8_t> masks(set.size());
    const OctreeSplit split{set, finder_.find(set, cell.place, masks), cell.place.box(grid_)};
    if (!divides(split, cell)) return make_leaf(set, cell, out, 0);

    std::array<OctreeSubtree, 8> parts;
    std::array<Grown, 8> grown;
    tbb::parallel_for(0u, 8u, [&](std::uint32_t octant) {
      if (split.octants.counts[octant] == 0) return;
      std::vector<std::uint32_t> part;
      part.reserve(split.octants.counts[octant]);
      append_octant(split, octant, part);
      parts[octant].add_siblings(1);
      grown[octant] = grow(part, cell.child(octant, speculative(split)), parts[octant]);
    });
    const Grown sum = sum_of(grown);
    if (is_better_whole(split, sum)) return make_leaf(set, cell, out, 0);
    std::size_t next = open_inner(split, cell, out, 0);
    for (const OctreeSubtree& part : parts) {
      if (!part.nodes.empty()) out.append(part, next++);
    }
    return close_inner(split, cell, sum, out, 0);
  }

  /// Builds the node at `place` of `out` and all that is below it.
  Grown grow_small(std::span<const std::uint32_t> set, const Cell& cell, Path& path, OctreeSubtree& out,
                   std::size_t place) {
    if (!may_divide(set, cell)) return make_leaf(set, cell, out, place);
    const std::uint32_t level = octree_level(cell.code);
    std::vector<std::uint8_t>& masks = path.levels[level].masks;
    masks.resize(set.size());
    const OctreeSplit split{set, finder_.find(set, cell.place, masks), cell.place.box(grid_)};
    if (!divides(split, cell)) return make_leaf(set, cell, out, place);

    const std::size_t nodes_before = out.nodes.size(), references_before = out.references.size();
    std::size_t next = open_inner(split, cell, out, place);
    std::array<Grown, 8> grown;
    for (std::uint32_t octant = 0; octant < 8; ++octant) {
      if (split.octants.counts[octant] == 0) continue;
      std::vector<std::uint32_t>& part = path.levels[level + 1].set;
      part.clear();
      append_octant(split, octant, part);
      grown[octant] = grow_small(part, cell.child(octant, speculative(split)), path, out, next++);
    }
    const Grown sum = sum_of(grown);
    if (is_better_whole(split, sum)) {
      out.cut_back(nodes_before, references_before);
      return make_leaf(set, cell, out, place);
    }
    return close_inner(split, cell, sum, out, place);
  }

  bool may_divide(std::span<const std::uint32_t> set, const Cell& cell) const {
    return set.size() >= options_.primitives && octree_level(cell.code) < options_.depth;
  }

  bool divides(const OctreeSplit& split, const Cell& cell) const {
    switch (options_.decider) {
      case OctreeDecider::multiplication:
        return split.multiplication() <= double{options_.multiplication};
      case OctreeDecider::depth:
        return true;
      case OctreeDecider::cluster:
        return !is_cluster(split, references_, options_);
      case OctreeDecider::sah:
        break;
    }
    return speculative(split) == 0 || cell.speculations < speculation_limit;
  }

  /// 1 when dividing the cell costs more than it saves, unless dividing its octants makes up for it.
  std::uint32_t speculative(const OctreeSplit& split) const {
    return options_.decider == OctreeDecider::sah && cost_of_split(split, options_) >= cost_of_leaf(split) ? 1 : 0;
  }

  Grown sum_of(const std::array<Grown, 8>& octants) const {
    Grown sum{double{options_.traversal_cost}, 0};
    for (const Grown& octant : octants) {
      sum.cost += octant_probability * octant.cost;
      sum.references += octant.references;
    }
    return sum;
  }

  bool is_better_whole(const OctreeSplit& split, const Grown& divided) const {
    return speculative(split) != 0 && cost_of_leaf(split) <= divided.cost;
  }

  /// A node for the octants, unless only one of them holds anything: that one then takes the place itself.
  static std::size_t open_inner(const OctreeSplit& split, const Cell& cell, OctreeSubtree& out, std::size_t place) {
    const std::uint32_t filled = split.octants.filled();
    if (filled == 1) return place;
    Tree::Node node;
    node.first = static_cast<std::uint32_t>(out.add_siblings(filled));
    node.count = filled & Tree::max_count;
    out.nodes[place] = node;
    out.codes[place] = cell.code;
    return node.first;
  }

  Grown close_inner(const OctreeSplit& split, const Cell& cell, const Grown& sum, OctreeSubtree& out,
                    std::size_t place) {
    if (split.octants.filled() > 1) {
      Tree::Node& node = out.nodes[place];
      for (std::uint32_t c = 0; c < node.count; ++c) node.bounds.grow(out.nodes[node.first + c].bounds);
    }
    // What is not to be undone any more is counted now.
    if (cell.speculations == 0 && speculative(split) != 0) settle(sum.references);
    return sum;
  }

  Grown make_leaf(std::span<const std::uint32_t> set, const Cell& cell, OctreeSubtree& out, std::size_t place) {
    if (set.size() > Tree::max_count) throw Error("a leaf of an octree takes at most 2^27 primitives");
    if (cell.speculations == 0) settle(set.size());
    Tree::Node leaf;
    leaf.first = static_cast<std::uint32_t>(out.references.size());
    leaf.count = static_cast<std::uint32_t>(set.size()) & Tree::max_count;
    leaf.leaf = 1;
    const Box box = cell.place.box(grid_);
    for (const std::uint32_t i : set) {
      const Reference& reference = references_[i];
      out.references.push_back(reference.primitive);
      // Rounding may clip away a part that only just reaches into the cell.
      const Box part = geometry_ ? geometry_->clip(reference.primitive, box) : Box{};
      leaf.bounds.grow(part.empty() ? intersect(reference.box(), box) : part);
    }
    out.nodes[place] = leaf;
    out.codes[place] = cell.code;
    return {static_cast<double>(set.size()), set.size()};
  }

  void settle(std::uint64_t references) {
    const std::uint64_t total = settled_.fetch_add(references) + references;
    if (total <= limit_ && total < (std::uint64_t{1} << 31)) return;
    throw Error(fmt::format(
        "the octree grows too large: {} primitives need more than {} references; raise primitives, "
        "lower multiplication or depth, or allow more with budget (now {:g} references per primitive)",
        references_.size(), std::min<std::uint64_t>(limit_, (std::uint64_t{1} << 31) - 1), options_.budget));
  }

  const OctreeOptions options_;
  const Geometry* geometry_;
  LargeVector<Reference> references_;
  OctreeGrid grid_;
  OctantFinder finder_;
  std::uint64_t limit_;
  std::atomic<std::uint64_t> settled_ = 0;
};

Tree build_octree(const OctreeOptions& options, BuildInput input) {
  if (input.references.empty()) return {};
  return OctreeBuilder(options, std::move(input)).run();
}

}  // namespace

Stage octree_builder_stage() {
  OptionsOf<OctreeOptions> options;
  options.integer("primitives", &OctreeOptions::primitives, 2, 1 << 20, "a cell with fewer becomes a leaf")
      .choice("decider", &OctreeOptions::decider, {"multiplication", "depth", "cluster", "sah"},
              "what else makes a leaf: too many references below, nothing, a clump that fills the cell, or the "
              "surface area cost of the whole subtree")
      .real("multiplication", &OctreeOptions::multiplication, 1, 8,
            "most references in the octants for each in the cell; for decider=multiplication")
      .integer("depth", &OctreeOptions::depth, 1, octree_levels, "deepest level of a cell")
      .real("share", &OctreeOptions::share, 0, 1,
            "part of the cell's references that an octant of a clump holds; for decider=cluster")
      .real("volume", &OctreeOptions::volume, 0, 1, "part of the cell that a clump fills; for decider=cluster")
      .real("traversal_cost", &OctreeOptions::traversal_cost, 0, 1e6f,
            "cost of entering a divided cell, in primitive tests; for decider=sah")
      .flag("exact", &OctreeOptions::exact, "put triangles only into cells they reach, not all that their box reaches")
      .real("budget", &OctreeOptions::budget, 1, 1e6f,
            "references per primitive at which the build gives up instead of filling the memory");
  Stage stage = builder_stage<OctreeOptions>(
      "octree", "cells halved along all axes; triangles in every cell they reach", "Kilian 2021; spec 004", options,
      build_octree, [](const OctreeOptions&) { return 8u; });
  stage.cells = true;
  return stage;
}

}  // namespace boxwood
