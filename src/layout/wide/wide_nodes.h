#pragma once
#include <cstddef>
#include <cstdint>

#include "boxwood/box.h"
#include "layout/aligned_vector.h"
#include "layout/kernel_layout.h"
#include "layout/link.h"
#include "layout/trace_options.h"
#include "tree/tree.h"

namespace boxwood {

/// Inner nodes of k lanes, in depth-first order; leaves are links in their parents. A node is 32 k bytes (k = 2, 4, 8:
/// one, two, four cache lines):
///        0  planes[6][k]   lower x, y, z, then upper x, y, z, of the children's boxes
///   24 * k  links[k]       of an inner child: first = its number among the nodes
/// A node's own link says how many of its lanes are used; the others are never read.
struct WideNodes {
  std::uint32_t k = 0;
  Box root_box;
  Link root;
  AlignedVector<float> memory;  ///< 8 k floats per node; links are stored in the bits of two

  bool empty() const { return root.count == 0; }
  std::size_t bytes() const { return memory.size() * sizeof(float); }
  void save(SavedLevel& out) const {
    out.facts.kind = SavedKind::wide;
    out.facts.children = k;
    out.facts.root_box = root_box;
    out.facts.root = root;
    out.nodes = std::as_bytes(std::span(memory));
  }
};

/// Of any tree. Throws UsageError on one of more than k children a node, Error on one too deep or too large.
WideNodes encode_wide_nodes(const Tree& tree, std::uint32_t k);

/// The fastest kernels this machine can run.
Kernels<WideNodes, TriangleLeaves> wide_triangle_kernels(const TraceOptions& options);
Kernels<WideNodes, InstanceLeaves> wide_instance_kernels(const TraceOptions& options);
/// The same with batches that enter instances together, where there are such for nodes of k children.
Kernels<WideNodes, InstanceLeaves> wide_instance_kernels_of(std::uint32_t k, const TraceOptions& options);

}  // namespace boxwood
