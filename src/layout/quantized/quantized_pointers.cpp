#include <fmt/format.h>

#include "boxwood/error.h"
#include "layout/encode.h"
#include "layout/quantized/quantized_nodes.h"

namespace boxwood {

QuantizedPointers encode_quantized_pointers(const Tree& tree) {
  check_walkable(tree, 2, "quantized(form=pointers)");
  QuantizedPointers out;
  if (tree.empty()) return out;
  out.root_box = tree.nodes[0].bounds;
  out.nodes.resize(tree.nodes.size());
  const std::vector<std::uint32_t> places = depth_first_places(tree, false);
  std::vector<Box> frames(tree.nodes.size());  // of a node's key: its parent's box as decoded
  frames[0] = out.root_box;
  for (std::size_t i = 0; i < tree.nodes.size(); ++i) {
    const Tree::Node& node = tree.nodes[i];
    PointerNode& to = out.nodes[places[i]];
    to.key = encode(node.bounds, frames[i]);
    to.axis = static_cast<std::uint8_t>(node.axis | node.fixed_order << 2);
    if (node.is_leaf()) {
      if (node.count > 0xffff) {
        throw Error(
            fmt::format("'quantized(form=pointers)' has room for 65535 references in a leaf, not {}; build "
                        "with smaller leaves",
                        std::uint32_t{node.count}));
      }
      to.first = node.first;
      to.count = static_cast<std::uint16_t>(node.count);
      continue;
    }
    to.first = places[node.first + 1];
    frames[node.first] = frames[node.first + 1] = decode(to.key, frames[i]);
  }
  return out;
}

}  // namespace boxwood
