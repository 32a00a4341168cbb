// The classic: two children per node, 32-byte nodes in depth-first order, as in Pharr, Jakob, Humphreys, "Physically
// Based Rendering", 4th ed., section 7.3.4.
#include "layout/binary/binary_nodes.h"
#include "layout/encode.h"
#include "layout/encode_level.h"
#include "layout/stages.h"

namespace boxwood {
namespace {

struct BinaryOptions {};  // no knobs

BinaryNodes encode_binary(const Tree& tree) {
  check_walkable(tree, 2, "binary");
  BinaryNodes out;
  out.nodes.resize(tree.nodes.size());
  const std::vector<std::uint32_t> places = depth_first_places(tree, false);
  for (std::size_t i = 0; i < tree.nodes.size(); ++i) {
    const Tree::Node& node = tree.nodes[i];
    out.nodes[places[i]] = {node.bounds, link_to(node, node.is_leaf() ? node.first : places[node.first + 1])};
  }
  return out;
}

struct ChooseBinary {
  auto operator()(const Level<BinaryNodes, TriangleLeaves>&, const TraceOptions& options) const {
    return binary_triangle_kernels(options);
  }
  auto operator()(const Level<BinaryNodes, InstanceLeaves>&, const TraceOptions& options) const {
    return binary_instance_kernels(options);
  }
};

std::shared_ptr<const Layout> encode(const BinaryOptions&, Tree tree, const Contents& contents,
                                     const TraceOptions& options) {
  return encode_level(std::move(tree), contents, options, encode_binary, ChooseBinary{});
}

}  // namespace

void BinaryNodes::refit(const Tree& tree) {
  const std::vector<std::uint32_t> places = depth_first_places(tree, false);
  for (std::size_t i = 0; i < tree.nodes.size(); ++i) nodes[places[i]].bounds = tree.nodes[i].bounds;
}

Stage binary_stage() {
  return layout_stage<BinaryOptions>("binary", "two children per node, 32-byte nodes in depth-first order",
                                     "Pharr, Jakob, Humphreys 2023", OptionsOf<BinaryOptions>(), encode,
                                     [](const BinaryOptions&) -> std::uint32_t { return 2; });
}

}  // namespace boxwood
