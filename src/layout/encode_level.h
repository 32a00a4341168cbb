#pragma once
#include <memory>
#include <utility>

#include "layout/kernel_layout.h"
#include "layout/trace_options.h"
#include "tree/tree.h"

namespace boxwood {

/// Encodes a tree over triangles or over instances, whichever `contents` holds. `encode(tree)` makes the nodes;
/// `choose(level, options)` gives the kernels for a level of either kind.
template <class Encode, class Choose>
std::shared_ptr<const Layout> encode_level(Tree tree, const Contents& contents, const TraceOptions& options,
                                           const Encode& encode, const Choose& choose) {
  const Box bounds = tree.empty() ? Box{} : tree.nodes[0].bounds;
  const auto finish = [&](auto leaves) -> std::shared_ptr<const Layout> {
    const Reach extent = extent_of(leaves, tree.references, bounds, contents);
    tree.references = {};
    using Nodes = decltype(encode(std::move(tree)));
    using Leaves = decltype(leaves);
    Level<Nodes, Leaves> level{encode(std::move(tree)), std::move(leaves), extent, options.cull};
    const Kernels<Nodes, Leaves> kernels = choose(level, options);
    return std::make_shared<KernelLayout<Nodes, Leaves>>(std::move(level), kernels);
  };
  if (contents.mesh) return finish(triangle_leaves(tree.references, *contents.mesh));
  return finish(instance_leaves(tree.references, contents));
}

}  // namespace boxwood
