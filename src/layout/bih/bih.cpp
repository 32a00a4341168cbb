// Bounding interval hierarchy: two planes across the split axis per inner node. Wächter, Keller 2006, "Instant Ray
// Tracing: The Bounding Interval Hierarchy"; here over any binary tree, not only over that of its own builder.
#include <fmt/format.h>

#include <vector>

#include "boxwood/error.h"
#include "layout/bih/bih_nodes.h"
#include "layout/encode.h"
#include "layout/encode_level.h"
#include "layout/slab/leaf_ends.h"
#include "layout/slab/split_encode.h"
#include "layout/stages.h"

namespace boxwood {
namespace {

struct BihOptions {};  // no knobs

BihNode encode_leaf(const Tree::Node& node) {
  BihNode out;
  out.planes[0] = std::bit_cast<float>(std::uint32_t{node.count});
  out.word = Word32(node.first, SplitFlags::leaf(0));
  return out;
}

BihNodes encode_bih(const Tree& tree) {
  check_walkable(tree, 2, "bih");
  BihNodes out;
  if (tree.empty()) return out;
  if (reference_count(tree) > Word32::most_indices || tree.nodes.size() / 2 > Word32::most_indices) {
    throw Error(fmt::format("'bih' has room for {} triangles, not {}; take slab(index=64)", Word32::most_indices,
                            reference_count(tree)));
  }
  out.root_box = tree.nodes[0].bounds;
  out.nodes.resize(tree.nodes.size());
  const std::vector<std::uint32_t> pairs = depth_first_places(tree, true);
  std::vector<std::size_t> places(tree.nodes.size());
  for (std::uint32_t i = 0; i < tree.nodes.size(); ++i) {
    const Tree::Node& node = tree.nodes[i];
    if (node.is_leaf()) {
      out.nodes[places[i]] = encode_leaf(node);
      continue;
    }
    const auto [axis, descending] = ascending_axis(tree, node);
    const std::uint32_t swap = descending && !node.fixed_order ? 1 : 0;
    const std::uint32_t first = node.first + swap, second = node.first + 1 - swap;
    BihNode& inner = out.nodes[places[i]];
    inner.planes[0] = tree.nodes[first].bounds.upper[axis];
    inner.planes[1] = tree.nodes[second].bounds.lower[axis];
    inner.word = Word32(pairs[i], SplitFlags::inner(2 * axis, axis, node.fixed_order));
    places[first] = 2 * std::size_t{pairs[i]} + 1;
    places[second] = places[first] + 1;
  }
  return out;
}

struct ChooseBih {
  auto operator()(const Level<BihNodes, TriangleLeaves>&, const TraceOptions& options) const {
    return bih_triangle_kernels(options);
  }
  auto operator()(const Level<BihNodes, InstanceLeaves>&, const TraceOptions& options) const {
    return bih_instance_kernels(options);
  }
};

std::shared_ptr<const Layout> encode(const BihOptions&, Tree tree, const Contents& contents,
                                     const TraceOptions& options) {
  return encode_level(std::move(tree), contents, options, encode_bih, ChooseBih{});
}

}  // namespace

Stage bih_stage() {
  return layout_stage<BihOptions>("bih", "two planes across the split axis per node, 12-byte nodes",
                                  "Wächter, Keller 2006", OptionsOf<BihOptions>(), encode,
                                  [](const BihOptions&) -> std::uint32_t { return 2; });
}

}  // namespace boxwood
