// Nodes of any width with their children's boxes side by side, after Ernst, Greiner 2008, "Multi Bounding Volume
// Hierarchies", and spec 000. Any width, any walk, instances too. Widths 4, 8 and 16 under the default walk have SIMD
// kernels of their own (../simd); what is here is scalar: width without wider arithmetic.
#include <fmt/format.h>

#include <cstring>

#include "boxwood/error.h"
#include "layout/encode.h"
#include "layout/encode_level.h"
#include "layout/simd/wide_simd.h"
#include "layout/stages.h"
#include "layout/wide/wide_nodes.h"
#include "tree/any_hit_order.h"

namespace boxwood {
namespace {

struct WideOptions {
  std::uint32_t k = 8;
};

/// Slots count links in 32 bits, and a node is as long as 4 k links.
void check_size(std::uint64_t inner_nodes, std::uint32_t k) {
  if (inner_nodes * 4 * k >> 32 == 0) return;
  throw Error(fmt::format("'wide({})' has room for {} inner nodes, not {}; use a smaller k or larger leaves", k,
                          (std::uint64_t{1} << 32) / (4 * k), inner_nodes));
}

void write_lane(const Tree::Node& child, std::uint32_t first, std::uint32_t k, std::uint32_t lane, float* node) {
  for (std::uint32_t axis = 0; axis < 3; ++axis) {
    node[axis * k + lane] = child.bounds.lower[axis];
    node[(axis + 3) * k + lane] = child.bounds.upper[axis];
  }
  const Link link = link_to(child, first);
  std::memcpy(node + 6 * std::size_t{k} + 2 * std::size_t{lane}, &link, sizeof link);
}

}  // namespace

WideNodes encode_wide_nodes(const Tree& tree, std::uint32_t k) {
  check_walkable(tree, k, fmt::format("wide({})", k));
  WideNodes out;
  out.k = k;
  if (tree.empty()) return out;
  std::uint64_t inner_nodes = 0;
  for (const Tree::Node& node : tree.nodes) inner_nodes += node.is_leaf() ? 0 : 1;
  check_size(inner_nodes, k);
  out.memory.resize(inner_nodes * 8 * k);

  const std::vector<std::uint32_t> places = depth_first_places(tree, true);
  const auto first_of = [&](std::uint32_t i) { return tree.nodes[i].is_leaf() ? tree.nodes[i].first : places[i]; };
  out.root_box = tree.nodes[0].bounds;
  out.root = link_to(tree.nodes[0], first_of(0));
  for (std::uint32_t i = 0; i < tree.nodes.size(); ++i) {
    const Tree::Node& node = tree.nodes[i];
    if (node.is_leaf()) continue;
    float* memory = out.memory.data() + std::size_t{places[i]} * 8 * k;
    for (std::uint32_t lane = 0; lane < node.count; ++lane) {
      write_lane(tree.nodes[node.first + lane], first_of(node.first + lane), k, lane, memory);
    }
  }
  return out;
}

namespace {

struct ChooseWide {
  auto operator()(const Level<WideNodes, TriangleLeaves>&, const TraceOptions& options) const {
    return wide_triangle_kernels(options);
  }
  auto operator()(const Level<WideNodes, InstanceLeaves>& level, const TraceOptions& options) const {
    return wide_instance_kernels_of(level.nodes.k, options);
  }
};

std::shared_ptr<const Layout> encode(const WideOptions& options, Tree tree, const Contents& contents,
                                     const TraceOptions& trace) {
  if (auto layout = encode_simd_wide(options.k, tree, contents, trace)) return layout;
  const auto nodes_of = [&](const Tree& t) { return encode_wide_nodes(t, options.k); };
  return encode_level(std::move(tree), contents, trace, nodes_of, ChooseWide{});
}

}  // namespace

Stage wide_stage() {
  Stage stage = layout_stage<WideOptions>(
      "wide", "up to k children per node, boxes side by side", "Ernst, Greiner 2008; spec 000",
      OptionsOf<WideOptions>().integer("k", &WideOptions::k, 2, 256, "most children per node").positional(), encode,
      [](const WideOptions& options) { return options.k; });
  stage.custom = true;
  stage.arrange = [](const std::any& options, const TraceOptions& trace, Tree& tree) {
    if (simd_wide_has_kernels(std::any_cast<const WideOptions&>(options).k, trace)) order_for_any_hits(tree);
  };
  return stage;
}

}  // namespace boxwood
