// Top-down building that may divide space instead of references: triangles across the border are cut and referred to
// from both sides. Stich, Friedrich and Dietrich 2009, "Spatial Splits in Bounding Volume Hierarchies".
#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_invoke.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <bit>
#include <memory>
#include <span>

#include "boxwood/error.h"
#include "build/large_leaf.h"
#include "build/spatial/fragments.h"
#include "build/spatial/split.h"
#include "build/spatial/stages.h"
#include "cost/registry.h"
#include "math/large_memory.h"
#include "tree/child_axis.h"

namespace boxwood {
namespace {

struct SpatialOptions {
  float alpha = 1e-5f;
  std::uint32_t bins = 16;
  float budget = 0.5f;
  bool unsplit = true;
  std::uint32_t leaf = 4;
  std::uint32_t block = 1;
  CostChoice cost;
};

/// References that one task builds over on its own.
constexpr std::uint32_t serial_size = 1 << 12;
/// Space is divided only where the parts would overlap by at least this part of the node: half the build time, and
/// trees no worse.
constexpr float least_overlap = 0.1f;
/// Times a reference's share of the scene's area from which a leaf is large.
constexpr float large_leaf = 64;
/// Below this level sets are halved by count, so that no input makes a deep tree.
constexpr std::uint32_t last_free_level = 64;

/// What one thread has written: nodes with their children side by side, and the primitives of leaves.
struct Sink {
  LargeVector<Tree::Node> nodes;
  LargeVector<std::uint32_t> references;
};

/// A part of the tree: divided further, or whole in a sink, the root first.
struct Branch {
  Box bounds;
  ChildAxis axis;
  std::unique_ptr<Branch> children[2];
  const Sink* sink = nullptr;  ///< null: divided further
  std::size_t first_node = 0, first_reference = 0, node_count = 0, reference_count = 0;
};

class SpatialBuilder {
 public:
  SpatialBuilder(const SpatialOptions& options, BuildInput input)
      : options_(options),
        price_{static_cast<std::uint32_t>(std::bit_width(options.block - 1))},
        geometry_(input.geometry),
        use_(input.use),
        size_(static_cast<std::uint32_t>(input.references.size())),
        array_(size_ + (geometry_ ? static_cast<std::size_t>(double{options_.budget} * size_) : 0)),
        dividers_([this] { return FragmentDivider(array_, geometry_, options_.unsplit); }),
        sinks_([this] { return make_sink(); }) {
    const LargeVector<Reference> references = std::move(input.references);
    std::copy(references.begin(), references.end(), array_.data());
  }

  Tree run() {
    Fragments all;
    all.end = size_;
    all.limit = static_cast<std::uint32_t>(array_.size());
    for (const Reference& reference : std::span<const Reference>(array_).first(size_)) {
      const Box4 box = box4(reference);
      all.bounds.grow(box);
      all.centers.grow(box.lower + box.upper);
    }
    if (!options_.cost.is_surface_area()) model_ = options_.cost.make({all.bounds.box(), use_});
    root_area_ = half_area(all.bounds);
    large_leaf_ = LargeLeaf(root_area_, size_, large_leaf);
    const std::unique_ptr<Branch> root = grow(all, 0, nullptr);
    Tree tree;
    tree.clipped_leaves = geometry_ != nullptr;
    const Sizes sizes = sizes_of(*root);
    tree.nodes.reserve(sizes.nodes);
    tree.references.reserve(sizes.references);
    tree.nodes.emplace_back();
    stitch(*root, 0, tree);
    return tree;
  }

 private:
  using Memory = std::shared_ptr<const CostModel::Memory>;

  Memory enter(const Fragments& node, const Memory& parent) const {
    return model_ ? model_->enter(node.bounds.box(), parent.get()) : nullptr;
  }

  /// Memory that stays untouched costs nothing, growing does.
  Sink make_sink() const {
    const std::size_t share = size_ / static_cast<std::size_t>(tbb::this_task_arena::max_concurrency());
    Sink sink;
    sink.nodes.reserve(2 * share);
    sink.references.reserve(share);
    return sink;
  }

  /// Space is divided only where the parts overlap by something that matters in the whole scene, which they do not in
  /// small nodes, nor below them.
  bool may_divide_space(const Fragments& node) const {
    return geometry_ && node.room() > 0 && half_area(node.bounds) >= options_.alpha * root_area_;
  }

  Split find_split(const Fragments& node, FragmentDivider& divider, const Memory& memory, bool& spatial) const {
    FragmentSet set{divider.references(node), node.bounds, node.centers};
    if (model_ && !model_->is_surface_area(memory.get())) set.model = model_.get(), set.memory = memory.get();
    const std::uint32_t bins = std::min(options_.bins, 4 + node.size() / 2);
    Split best = find_object_split(set, bins, price_);
    spatial = false;
    if (!may_divide_space(node)) return best;
    if (best.found()) {
      const Box overlap = intersect(best.left.box(), best.right.box());
      const float least = std::max(options_.alpha * root_area_, least_overlap * half_area(node.bounds));
      if (overlap.empty() || half_area(overlap) < least) return best;
    }
    const Split space = find_spatial_split(set, *geometry_, bins, price_);
    const std::uint32_t count = space.left_count + space.right_count;
    const bool progress = space.left_count < node.size() && space.right_count < node.size();
    if (space.cost < best.cost && progress && count - node.size() <= node.room()) {
      spatial = true;
      return space;
    }
    return best;
  }

  /// False: the node is to be a leaf.
  bool divide(const Fragments& node, std::uint32_t level, const Memory& memory, FragmentDivider& divider,
              FragmentPair& parts) const {
    const std::uint32_t count = node.size();
    const float area = half_area(node.bounds);
    // One block of references is only divided when it is large.
    const bool one_block = count <= options_.leaf && price_(count) <= 1;
    if (one_block && (count == 1 || !large_leaf_.is_large(area))) return false;
    bool spatial = false;
    const Split split = level < last_free_level ? find_split(node, divider, memory, spatial) : Split{};
    if (one_block && !large_leaf_.is_better_in_halves(area, split.cost)) return false;
    if (!one_block && count <= options_.leaf && area * price_(count) <= area + split.cost) return false;
    if (!split.found()) {
      parts = divider.by_count(node);
    } else if (!spatial) {
      parts = divider.by_centers(node, split, may_divide_space(node));
    } else {
      parts = divider.by_space(node, split);
      // Nothing was cut after all.
      if (parts.left.size() == 0) parts = divider.by_count(parts.right);
      if (parts.right.size() == 0) parts = divider.by_count(parts.left);
    }
    return true;
  }

  /// Builds over many references with a task for each side.
  std::unique_ptr<Branch> grow(const Fragments& node, std::uint32_t level, const Memory& parent) {
    auto branch = std::make_unique<Branch>();
    branch->bounds = node.bounds.box();
    if (node.size() <= serial_size) {
      write_branch(node, level, parent, *branch);
      return branch;
    }
    const Memory memory = enter(node, parent);
    FragmentPair parts;
    divide(node, level, memory, dividers_.local(), parts);  // It is far too large for a leaf.
    order(parts, branch->axis);
    tbb::parallel_invoke([&] { branch->children[0] = grow(parts.left, level + 1, memory); },
                         [&] { branch->children[1] = grow(parts.right, level + 1, memory); });
    return branch;
  }

  void write_branch(const Fragments& node, std::uint32_t level, const Memory& parent, Branch& branch) {
    Sink& sink = sinks_.local();
    branch.sink = &sink;
    branch.first_node = sink.nodes.size();
    branch.first_reference = sink.references.size();
    sink.nodes.emplace_back();
    write(node, level, parent, branch.first_node, sink, dividers_.local());
    branch.node_count = sink.nodes.size() - branch.first_node;
    branch.reference_count = sink.references.size() - branch.first_reference;
  }

  /// Puts the sides in ascending order along the axis that separates them best.
  static void order(FragmentPair& parts, ChildAxis& axis) {
    axis = child_axis(parts.left.bounds.box(), parts.right.bounds.box());
    if (axis.descending) std::swap(parts.left, parts.right);
  }

  /// Sets sink.nodes[place] and appends all that is below it, depth first with siblings side by side.
  void write(const Fragments& node, std::uint32_t level, const Memory& parent, std::size_t place, Sink& sink,
             FragmentDivider& divider) {
    const Memory memory = enter(node, parent);
    Tree::Node out;
    out.bounds = node.bounds.box();
    FragmentPair parts;
    if (!divide(node, level, memory, divider, parts)) {
      out.leaf = 1;
      out.first = static_cast<std::uint32_t>(sink.references.size());
      out.count = append_primitives(node, sink.references) & Tree::max_count;
      sink.nodes[place] = out;
      return;
    }
    ChildAxis axis;
    order(parts, axis);
    const std::size_t first = sink.nodes.size();
    out.first = static_cast<std::uint32_t>(first);
    out.count = 2;
    out.axis = axis.axis & 3;
    sink.nodes[place] = out;
    sink.nodes.resize(first + 2);
    write(parts.left, level + 1, memory, first, sink, divider);
    write(parts.right, level + 1, memory, first + 1, sink, divider);
  }

  /// Two parts of one primitive in the same leaf are one. Returns how many were appended.
  std::uint32_t append_primitives(const Fragments& node, LargeVector<std::uint32_t>& references) const {
    const auto first = static_cast<std::ptrdiff_t>(references.size());
    for (std::uint32_t i = node.begin; i < node.end; ++i) {
      const std::uint32_t primitive = array_[i].primitive;
      if (std::find(references.begin() + first, references.end(), primitive) == references.end()) {
        references.push_back(primitive);
      }
    }
    return static_cast<std::uint32_t>(references.size()) - static_cast<std::uint32_t>(first);
  }

  struct Sizes {
    std::size_t nodes = 0, references = 0;
  };

  static Sizes sizes_of(const Branch& branch) {
    if (branch.sink) return {branch.node_count, branch.reference_count};
    const Sizes left = sizes_of(*branch.children[0]), right = sizes_of(*branch.children[1]);
    return {1 + left.nodes + right.nodes, left.references + right.references};
  }

  /// Sets tree.nodes[place] to a branch's root and appends the rest of it.
  static void stitch(const Branch& branch, std::size_t place, Tree& tree) {
    const auto first = static_cast<std::uint32_t>(tree.nodes.size());
    if (branch.sink) {
      const auto first_reference = static_cast<std::uint32_t>(tree.references.size());
      const auto nodes = std::span(branch.sink->nodes).subspan(branch.first_node, branch.node_count);
      const auto references =
          std::span(branch.sink->references).subspan(branch.first_reference, branch.reference_count);
      const auto settled = [&](Tree::Node node) {
        node.first += static_cast<std::uint32_t>(node.is_leaf() ? first_reference - branch.first_reference
                                                                : first - 1 - branch.first_node);
        return node;
      };
      tree.references.insert(tree.references.end(), references.begin(), references.end());
      tree.nodes[place] = settled(nodes.front());
      for (const Tree::Node& node : nodes.subspan(1)) tree.nodes.push_back(settled(node));
      return;
    }
    Tree::Node& node = tree.nodes[place];
    node.bounds = branch.bounds;
    node.first = first;
    node.count = 2;
    node.axis = branch.axis.axis & 3;
    tree.nodes.resize(first + 2);
    stitch(*branch.children[0], first, tree);
    stitch(*branch.children[1], first + 1, tree);
  }

  SpatialOptions options_;
  std::unique_ptr<CostModel> model_;  // null: surface area
  LeafPrice price_;
  const Geometry* geometry_;
  const KnownUse* use_;
  std::uint32_t size_;
  RawArray<Reference> array_;  ///< with room for parts
  float root_area_ = 0;
  LargeLeaf large_leaf_;
  tbb::enumerable_thread_specific<FragmentDivider> dividers_;
  tbb::enumerable_thread_specific<Sink> sinks_;
};

Tree build_spatial(const SpatialOptions& options, BuildInput input) {
  if (input.references.empty()) return {};
  const double most = static_cast<double>(input.references.size()) * (1 + double{options.budget});
  if (most >= 2147483648.0) {
    throw Error("'spatial' takes at most 2^31 references, cut ones included; lower its budget or split the scene");
  }
  mark_seen(input);
  return SpatialBuilder(options, std::move(input)).run();
}

}  // namespace

Stage spatial_stage() {
  OptionsOf<SpatialOptions> options;
  options
      .real("alpha", &SpatialOptions::alpha, 0, 1,
            "overlap, as a part of the scene's area, from which space is divided")
      .integer("bins", &SpatialOptions::bins, 2, max_spatial_bins, "bins per axis")
      .real("budget", &SpatialOptions::budget, 0, 4, "references that cuts may add, as a part of all primitives")
      .flag("unsplit", &SpatialOptions::unsplit, "leave a primitive whole on one side where that is cheaper")
      .integer("leaf", &SpatialOptions::leaf, 1, 64, "most references in a leaf")
      .integer("block", &SpatialOptions::block, 1, 16, "references tested at the price of one; a power of two");
  add_cost_choice(options, "cost", &SpatialOptions::cost, "how likely a ray is taken to enter a side of a split");
  Stage stage =
      builder_stage<SpatialOptions>("spatial", "splits by cost, of references or of space", "Stich et al. 2009 (SBVH)",
                                    options, build_spatial, [](const SpatialOptions&) { return 2u; });
  stage.needs_use = [](const std::any& chosen) {
    return std::any_cast<const SpatialOptions&>(chosen).cost.needs_use();
  };
  return stage;
}

}  // namespace boxwood
