#pragma once
#include <memory>
#include <utility>

#include "layout/kernel_layout.h"
#include "layout/octree/octree_head.h"
#include "layout/octree/octree_topology.h"

namespace boxwood {

/// Encodes an octree over triangles or over instances, whichever `contents` holds. `encode(topology, references)` makes
/// the nodes, all but their head, and appends each leaf's references; `kernels(level)` gives the kernels for a level of
/// either kind.
template <class Encode, class Choose>
std::shared_ptr<const Layout> encode_octree(const Tree& tree, const Contents& contents, const TraceOptions& trace,
                                            bool mailbox, const Encode& encode, const Choose& kernels) {
  OctreeReferences references;
  auto nodes = encode(OctreeTopology(tree), references);
  nodes.head.grid = tree.cells.grid;
  nodes.head.filled = !tree.empty();
  nodes.head.primitives = references.primitives.size();
  nodes.head.references = std::move(references.references);
  nodes.head.mailbox = mailbox;
  nodes.head.trace = trace;
  const Box bounds = tree.empty() ? Box{} : octree_cell(octree_root).box(tree.cells.grid);
  const auto finish = [&](auto leaves) -> std::shared_ptr<const Layout> {
    const Reach extent = extent_of(leaves, references.primitives, bounds, contents);
    Level<decltype(nodes), decltype(leaves)> level{std::move(nodes), std::move(leaves), extent, trace.cull};
    const auto chosen = kernels(level);
    return std::make_shared<KernelLayout<decltype(nodes), decltype(leaves)>>(std::move(level), chosen);
  };
  if (contents.mesh) return finish(triangle_leaves(references.primitives, *contents.mesh));
  return finish(instance_leaves(references.primitives, contents));
}

}  // namespace boxwood
