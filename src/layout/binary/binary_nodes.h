#pragma once
#include <cstddef>

#include "boxwood/box.h"
#include "layout/aligned_vector.h"
#include "layout/kernel_layout.h"
#include "layout/link.h"
#include "layout/trace_options.h"

namespace boxwood {

/// One node, 32 bytes, two per cache line:
///    0  bounds   box
///   24  link     of an inner node: first = its second child; the first child follows the node
struct BinaryNode {
  Box bounds;
  Link link;
};
static_assert(sizeof(BinaryNode) == 32);

/// Nodes in depth-first order, the root first.
struct BinaryNodes {
  AlignedVector<BinaryNode> nodes;

  bool empty() const { return nodes.empty(); }
  std::size_t bytes() const { return nodes.size() * sizeof(BinaryNode); }
  /// New boxes of the same tree. O(nodes).
  void refit(const Tree& tree);
  void save(SavedLevel& out) const {
    out.facts.kind = SavedKind::binary;
    out.nodes = std::as_bytes(std::span(nodes));
  }
};

/// The fastest kernels this machine can run.
Kernels<BinaryNodes, TriangleLeaves> binary_triangle_kernels(const TraceOptions& options);
Kernels<BinaryNodes, InstanceLeaves> binary_instance_kernels(const TraceOptions& options);

}  // namespace boxwood
