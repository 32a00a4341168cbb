// Slabs for wide nodes: one to six planes per child instead of a box, all children tested together. Ours, after the
// single slab hierarchy (spec 003); six planes are the box of a wide layout in another coding.
#include <fmt/format.h>

#include <bit>
#include <cmath>
#include <limits>
#include <vector>

#include "boxwood/error.h"
#include "layout/encode.h"
#include "layout/encode_level.h"
#include "layout/slab/slab_planes.h"
#include "layout/slab/wide/wide_slab_nodes.h"
#include "layout/stages.h"

namespace boxwood {
namespace {

struct WideSlabOptions {
  std::uint32_t k = 8;
  std::uint32_t planes = 2;
};

void check_size(const Tree& tree, std::uint64_t inner_nodes) {
  if (inner_nodes <= WideSlabChild::most_nodes && reference_count(tree) <= WideSlabChild::most_references) return;
  throw Error(fmt::format("'wide-slab' has room for {} nodes, not {}; use a larger k, larger leaves, or 'wide'",
                          WideSlabChild::most_nodes, inner_nodes));
}

constexpr std::uint32_t nothing = 6;  // the bits of a plane that nothing meets

WideSlabNodes encode_wide_slab(const Tree& tree, const WideSlabOptions& options) {
  check_walkable(tree, options.k, fmt::format("wide-slab({})", options.k));
  WideSlabNodes out;
  out.k = options.k;
  out.planes = options.planes;
  if (tree.empty()) return out;
  std::uint64_t inner_nodes = 0;
  for (const Tree::Node& node : tree.nodes) inner_nodes += node.is_leaf() ? 0 : 1;
  check_size(tree, inner_nodes);
  out.memory.assign(inner_nodes * out.stride(), nothing);
  out.leaf_ends = LeafEnds(tree);
  const std::vector<std::uint32_t> places = depth_first_places(tree, true);
  out.root_box = tree.nodes[0].bounds;
  out.root = link_to(tree.nodes[0], tree.nodes[0].is_leaf() ? tree.nodes[0].first : places[0]);

  std::vector<Box> regions(tree.nodes.size());
  regions[0] = out.root_box;
  for (std::uint32_t i = 0; i < tree.nodes.size(); ++i) {
    const Tree::Node& node = tree.nodes[i];
    if (node.is_leaf()) continue;
    std::uint32_t* memory = out.memory.data() + std::size_t{places[i]} * out.stride();
    for (std::uint32_t lane = 0; lane < node.count; ++lane) {
      const std::uint32_t number = node.first + lane;
      const Tree::Node& child = tree.nodes[number];
      regions[number] = regions[i];
      for (std::uint32_t plane = 0; plane < options.planes; ++plane) {
        const BoxSide side = cut_by_best_side(child.bounds, regions[number]);
        const float coded = plane_with_side(side_of(child.bounds, side), side);
        memory[plane * options.k + lane] = std::bit_cast<std::uint32_t>(coded);
      }
      memory[options.planes * options.k + lane] =
          (child.is_leaf() ? WideSlabChild::leaf(child.first) : WideSlabChild::inner(child, places[number])).word;
    }
  }
  return out;
}

struct ChooseWideSlab {
  std::uint32_t k;
  auto operator()(const Level<WideSlabNodes, TriangleLeaves>&, const TraceOptions& options) const {
    return wide_slab_triangle_kernels(options, k);
  }
  auto operator()(const Level<WideSlabNodes, InstanceLeaves>&, const TraceOptions& options) const {
    return wide_slab_instance_kernels(options, k);
  }
};

std::shared_ptr<const Layout> encode(const WideSlabOptions& options, Tree tree, const Contents& contents,
                                     const TraceOptions& trace) {
  const auto nodes_of = [&](const Tree& t) { return encode_wide_slab(t, options); };
  return encode_level(std::move(tree), contents, trace, nodes_of, ChooseWideSlab{options.k});
}

}  // namespace

float plane_with_side(float value, BoxSide side) {
  const float outward = (side & 1 ? 1.0f : -1.0f) * std::numeric_limits<float>::infinity();
  while ((std::bit_cast<std::uint32_t>(value) & 7) != side) value = std::nextafter(value, outward);
  return value;
}

Stage wide_slab_stage() {
  return layout_stage<WideSlabOptions>(
      "wide-slab", "up to k children per node, 1 to 6 planes each instead of a box", "after spec 003",
      OptionsOf<WideSlabOptions>()
          .integer("k", &WideSlabOptions::k, 2, 16, "most children per node; 8 and 16 are tested by SIMD")
          .positional()
          .integer("planes", &WideSlabOptions::planes, 1, 6, "planes per child"),
      encode, [](const WideSlabOptions& options) { return options.k; });
}

}  // namespace boxwood
