// Runs of references with equal leading Morton bits become treelets, split bit by bit; their roots are gathered by
// binned surface area cost. Pharr, Jakob, Humphreys 2016, section 4.3.3, after Pantaleoni and Luebke 2010, "HLBVH", and
// Garanzha, Pantaleoni, McAllister 2011. hlbvh() is pbrt's and the PCA study's `hlbvh`, but where all treelets have one
// centre they are halved by count, where pbrt aborts.
#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>

#include "boxwood/error.h"
#include "build/binned_cuts.h"
#include "build/morton/radix_sort.h"
#include "build/morton/stages.h"
#include "build/reduce.h"
#include "math/large_memory.h"

namespace boxwood {
namespace {

constexpr unsigned axis_bits = 10, code_bits = 3 * axis_bits, treelet_bits = 12;
constexpr std::size_t code_grain = 1 << 13;

struct HlbvhOptions {
  std::uint32_t leaf = 4;
};

/// Moves bit i of a number below 2^10 to bit 3i.
std::uint32_t spread(std::uint32_t x) {
  x = (x | x << 16) & 0x030000ff;
  x = (x | x << 8) & 0x0300f00f;
  x = (x | x << 4) & 0x030c30c3;
  return (x | x << 2) & 0x09249249;
}

/// References in the order of their codes: the code above the place in the input.
class SortedCodes {
 public:
  explicit SortedCodes(std::span<const Reference> references) : keys_(references.size()) {
    const Box4 box = centers_of(references);
    const Float4 extent = box.upper - box.lower;
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, references.size(), code_grain), [&](const auto& range) {
      for (std::size_t i = range.begin(); i < range.end(); ++i) {
        const Float4 center = box4(references[i]).lower + box4(references[i]).upper;
        std::uint64_t code = 0;
        for (int axis = 0; axis < 3; ++axis) code |= spread(cell(center[axis] - box.lower[axis], extent[axis])) << axis;
        keys_[i] = code << 32 | i;
      }
    });
    radix_sort(keys_, 32);
  }

  std::uint32_t size() const { return static_cast<std::uint32_t>(keys_.size()); }
  std::uint32_t code(std::uint32_t i) const { return static_cast<std::uint32_t>(keys_[i] >> 32); }
  std::uint32_t reference(std::uint32_t i) const { return static_cast<std::uint32_t>(keys_[i]); }

  /// The first of [begin, end) whose bit is set, all of them having the same bits above it.
  std::uint32_t first_with(unsigned bit, std::uint32_t begin, std::uint32_t end) const {
    const std::uint64_t border = (std::uint64_t{code(begin)} >> bit | 1) << bit << 32;
    const std::span<const std::uint64_t> part = std::span<const std::uint64_t>(keys_).subspan(begin, end - begin);
    return begin + static_cast<std::uint32_t>(std::ranges::lower_bound(part, border) - part.begin());
  }

 private:
  static Box4 centers_of(std::span<const Reference> references) {
    const auto fold = [](std::span<const Reference> part, Box4 box) {
      for (const Reference& reference : part) box.grow(box4(reference).lower + box4(reference).upper);
      return box;
    };
    return reduce(references, Box4{}, fold, [](Box4 a, const Box4& b) {
      a.grow(b);
      return a;
    });
  }
  static std::uint32_t cell(float offset, float extent) {
    constexpr float cells = 1u << axis_bits;
    return extent > 0 ? static_cast<std::uint32_t>(std::min(offset / extent * cells, cells - 1)) : 0;
  }

  RawArray<std::uint64_t> keys_;
};

/// References [begin, end) in the order of their codes, and the nodes over them: the root first, places counted from
/// it.
struct Treelet {
  std::uint32_t begin, end;
  std::vector<Tree::Node> nodes;
};

class TreeletBuilder {
 public:
  TreeletBuilder(std::span<const Reference> references, const SortedCodes& codes, std::uint32_t leaf)
      : references_(references), codes_(codes), leaf_(leaf) {}

  void build(Treelet& treelet) const {
    treelet.nodes.emplace_back();
    split(treelet, 0, treelet.begin, treelet.end, code_bits - treelet_bits);
  }

 private:
  /// Sets nodes[place] over [begin, end), where the codes differ in the lowest `bits` bits only. At most 18 levels
  /// deep.
  void split(Treelet& treelet, std::size_t place, std::uint32_t begin, std::uint32_t end, unsigned bits) const {
    Tree::Node node;
    std::uint32_t middle = begin;
    // Skip bits that all have in common.
    while (bits > 0 && end - begin >= std::max(leaf_, 2u) && (middle == begin || middle == end)) {
      middle = codes_.first_with(--bits, begin, end);
    }
    if (middle == begin || middle == end) {
      for (std::uint32_t i = begin; i < end; ++i) node.bounds.grow(references_[codes_.reference(i)].box());
      node.first = begin;
      node.count = (end - begin) & Tree::max_count;
      node.leaf = 1;
    } else {
      const std::size_t first = treelet.nodes.size();
      treelet.nodes.resize(first + 2);
      split(treelet, first, begin, middle, bits);
      split(treelet, first + 1, middle, end, bits);
      node.bounds = unite(treelet.nodes[first].bounds, treelet.nodes[first + 1].bounds);
      node.first = static_cast<std::uint32_t>(first);
      node.count = 2;
      node.axis = (bits % 3) & 3;
    }
    treelet.nodes[place] = node;
  }

  std::span<const Reference> references_;
  const SortedCodes& codes_;
  std::uint32_t leaf_;
};

std::vector<Treelet> build_treelets(std::span<const Reference> references, const SortedCodes& codes,
                                    std::uint32_t leaf) {
  std::vector<Treelet> treelets;
  const auto group = [&](std::uint32_t i) { return codes.code(i) >> (code_bits - treelet_bits); };
  for (std::uint32_t begin = 0, i = 1; i <= codes.size(); ++i) {
    if (i < codes.size() && group(i) == group(begin)) continue;
    treelets.push_back({begin, i, {}});
    begin = i;
  }
  const TreeletBuilder builder(references, codes, leaf);
  tbb::parallel_for(std::size_t{0}, treelets.size(), [&](std::size_t i) { builder.build(treelets[i]); });
  return treelets;
}

/// A tree with one treelet per leaf.
Tree gather(const std::vector<Treelet>& treelets) {
  BuildInput roots;
  for (std::uint32_t i = 0; i < treelets.size(); ++i) {
    const Box& box = treelets[i].nodes.front().bounds;
    roots.references.push_back({box.lower, i, box.upper});
  }
  const Centroids centroids(roots, CentroidKind::box);
  return build_top_down(std::move(roots), centroids, 1, [&](const ReferenceSet& set) {
    SurfaceAreaPricing pricing;
    if (!pricing.begin(set)) return Cuts{};
    constexpr std::uint32_t bins = 12;
    const int axis = longest_axis(set.centers);
    return apply(find_binned_cuts(set, centroids, set.centers, {axis, axis}, bins, CostOptions{}, pricing), set,
                 centroids);
  });
}

/// Puts a treelet in the place of the leaf that stands for it.
void graft(const Treelet& treelet, std::size_t place, Tree& tree) {
  const auto first = static_cast<std::uint32_t>(tree.nodes.size());
  tree.nodes.insert(tree.nodes.end(), treelet.nodes.begin() + 1, treelet.nodes.end());
  const auto settle = [&](Tree::Node& node) { node.first += node.is_leaf() ? 0 : first - 1; };
  tree.nodes[place] = treelet.nodes.front();
  settle(tree.nodes[place]);
  for (std::size_t i = first; i < tree.nodes.size(); ++i) settle(tree.nodes[i]);
}

Tree build_hlbvh(const HlbvhOptions& options, BuildInput input) {
  if (input.references.empty()) return {};
  if (input.references.size() > Tree::max_count) {
    throw Error("'hlbvh' takes at most 2^27 primitives; split the scene into instances");
  }
  const SortedCodes codes(input.references);
  const std::vector<Treelet> treelets = build_treelets(input.references, codes, options.leaf);
  Tree tree = gather(treelets);
  const std::size_t upper_nodes = tree.nodes.size();
  for (std::size_t i = 0; i < upper_nodes; ++i) {
    if (tree.nodes[i].is_leaf()) graft(treelets[tree.references[tree.nodes[i].first]], i, tree);
  }
  tree.references.resize(codes.size());
  for (std::uint32_t i = 0; i < codes.size(); ++i) tree.references[i] = input.references[codes.reference(i)].primitive;
  return tree;
}

}  // namespace

Stage hlbvh_stage() {
  OptionsOf<HlbvhOptions> options;
  options.integer("leaf", &HlbvhOptions::leaf, 1, 64,
                  "fewer references than this become a leaf; more only where Morton codes of 30 bits do not part them");
  return builder_stage<HlbvhOptions>("hlbvh", "splits runs of equal Morton bits, joined by surface area cost",
                                     "Pharr, Jakob, Humphreys 2016 (HLBVH); Pantaleoni and Luebke 2010; PCA study",
                                     options, build_hlbvh, [](const HlbvhOptions&) { return 2u; });
}

}  // namespace boxwood
