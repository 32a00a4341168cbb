#include "layout/binary/binary_nodes.h"
#include "layout/encode.h"
#include "layout/saved_kind.h"

namespace boxwood {
namespace {

Kernels<BinaryNodes, TriangleLeaves> kernels_of(const Level<BinaryNodes, TriangleLeaves>&, const TraceOptions& trace) {
  return binary_triangle_kernels(trace);
}
Kernels<BinaryNodes, InstanceLeaves> kernels_of(const Level<BinaryNodes, InstanceLeaves>&, const TraceOptions& trace) {
  return binary_instance_kernels(trace);
}

/// Nodes in depth-first order are each reached once, in the order in which they stand, or the tree is damaged.
std::string binary_damage(const SavedLevel& level) {
  const auto nodes = elements_of<BinaryNode>(level.nodes, "nodes");
  const std::size_t leaves = leaf_entries(level);
  if (nodes.empty()) return leaves == 0 ? std::string() : "it has leaves but no nodes";
  struct Pending {
    std::uint32_t node, need;  // need: entries that a walk's stack holds there at most
  };
  std::vector<Pending> second_children;
  std::uint32_t need = 1;
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    const auto& [bounds, link] = nodes[i];
    if (!is_sound(bounds)) return fmt::format("node {} has no proper box", i);
    if (!link.leaf) {
      if (link.count != 2 || link.unused || link.first <= i + 1 || link.first >= nodes.size()) {
        return fmt::format("node {} has children that it cannot have", i);
      }
      second_children.push_back({link.first, ++need});
      if (need > stack_entries) return "it is deeper than any walk can go";
      continue;
    }
    if (!is_sound_leaf(link, leaves)) return fmt::format("leaf {} holds entries that it cannot have", i);
    const bool last = i + 1 == nodes.size();
    if (second_children.empty() != last) return fmt::format("its nodes from {} on belong to no tree", i + 1);
    if (last) break;
    if (second_children.back().node != i + 1) return fmt::format("node {} is not where its parent says", i + 1);
    need = second_children.back().need;
    second_children.pop_back();
  }
  return second_children.empty() ? std::string() : "its last nodes are missing";
}

std::shared_ptr<const Layout> restore_binary(const SavedLevel& level, const TraceOptions& trace) {
  const auto saved = elements_of<BinaryNode>(level.nodes, "nodes");
  BinaryNodes nodes{{saved.begin(), saved.end()}};
  return kernel_layout_of(std::move(nodes), level, trace,
                          [](const auto& l, const TraceOptions& t) { return kernels_of(l, t); });
}

Box binary_bounds(const SavedLevel& level) {
  const auto nodes = elements_of<BinaryNode>(level.nodes, "nodes");
  return nodes.empty() ? Box{} : nodes[0].bounds;
}

}  // namespace

SavedKindEntry saved_binary() { return {SavedKind::binary, binary_damage, restore_binary, binary_bounds}; }

}  // namespace boxwood
