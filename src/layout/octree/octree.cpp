// Octree of 32-bit nodes whose boxes are implied: Kilian 2021, spec 004, section 2.2.
#include "boxwood/error.h"
#include "layout/octree/encode_octree.h"
#include "layout/octree/octree_nodes.h"
#include "layout/octree/stages.h"

namespace boxwood {
namespace {

struct OctreeLayoutOptions {
  bool mailbox = true;
};

constexpr std::uint64_t most = 0x7fffffff;  // of nodes and of references: 31 bits

/// Depth first, siblings together.
OctreeNodes encode_octree_words(const OctreeTopology& topology, const Tree& tree, OctreeReferences& references) {
  OctreeNodes out;
  out.words.assign(8, OctreeNodes::empty_leaf);
  out.sizes.assign(8, 0);
  struct Pending {
    OctreeItem item;
    std::uint32_t place;
  };
  std::vector<Pending> stack{{topology.root(), 0}};
  while (!stack.empty()) {
    const Pending pending = stack.back();
    stack.pop_back();
    if (pending.item.empty()) continue;
    if (!topology.is_inner(pending.item)) {
      const Tree::Node& leaf = topology.leaf(pending.item);
      out.words[pending.place] = static_cast<std::uint32_t>(references.references.size()) << 1;
      out.sizes[pending.place] = leaf.count;
      references.append({tree.references.data() + leaf.first, leaf.count});
      continue;
    }
    ++out.head.inner_nodes;
    const auto first = static_cast<std::uint32_t>(out.words.size());
    if (first + std::uint64_t{8} > most || references.references.size() >= most) {
      throw Error("'octree' has room for 2^31 nodes and as many references; raise the builder's 'primitives'");
    }
    out.words[pending.place] = first << 1 | 1;
    out.words.resize(first + 8, OctreeNodes::empty_leaf);
    out.sizes.resize(first + 8);
    OctreeItem children[8];
    topology.children(pending.item, children);
    for (std::uint32_t octant = 8; octant-- > 0;) stack.push_back({children[octant], first + octant});
  }
  return out;
}

struct ChooseOctree {
  auto operator()(const Level<OctreeNodes, TriangleLeaves>&) const { return octree_triangle_kernels(); }
  auto operator()(const Level<OctreeNodes, InstanceLeaves>&) const { return octree_instance_kernels(); }
};

std::shared_ptr<const Layout> encode(const OctreeLayoutOptions& options, Tree tree, const Contents& contents,
                                     const TraceOptions& trace) {
  const auto nodes_of = [&](const OctreeTopology& topology, OctreeReferences& references) {
    return encode_octree_words(topology, tree, references);
  };
  return encode_octree(tree, contents, trace, options.mailbox, nodes_of, ChooseOctree{});
}

}  // namespace

Stage octree_layout_stage() {
  Stage stage = layout_stage<OctreeLayoutOptions>(
      "octree", "octree of 32-bit nodes; boxes are implied by the path", "Kilian 2021; spec 004",
      OptionsOf<OctreeLayoutOptions>().flag("mailbox", &OctreeLayoutOptions::mailbox,
                                            "remember what was tested, for primitives in many cells"),
      encode, [](const OctreeLayoutOptions&) { return 8u; });
  stage.cells = true;
  return stage;
}

}  // namespace boxwood
