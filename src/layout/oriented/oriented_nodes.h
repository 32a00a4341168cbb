#pragma once
#include <cstddef>
#include <cstdint>

#include "boxwood/box.h"
#include "boxwood/scene.h"
#include "layout/aligned_vector.h"
#include "layout/kernel_layout.h"
#include "layout/link.h"
#include "layout/trace_options.h"
#include "tree/tree.h"

namespace boxwood {

/// Inner nodes of k lanes, in depth-first order; leaves are links in their parents. A node is 32 k bytes, and 48 more
/// when it is turned (k = 2: one cache line, or two):
///        0  planes[6][k]   lower x, y, z, then upper x, y, z, of the children's boxes, in the node's frame
///   24 * k  links[k]       of an inner child: first = twice its place in memory, in units of 16 bytes, plus 1 if
///   turned 32 * k  frame[3][4]    of a turned node: three axes, each with a float unused; a point p lies at (frame[i]
///   . p)
/// The frame is what its floats say, orthonormal only to rounding: any linear map keeps rays straight and t the same.
struct OrientedNodes {
  std::uint32_t k = 0;
  Box root_box;
  float reach = 0;  ///< largest absolute coordinate of root_box
  Link root;
  AlignedVector<float> memory;  ///< links are stored in the bits of two floats
  std::uint32_t inner_nodes = 0, turned_nodes = 0;

  bool empty() const { return root.count == 0; }
  std::size_t bytes() const { return memory.size() * sizeof(float); }
};

inline constexpr std::size_t oriented_unit = 4;  ///< floats per unit of a node's place
inline constexpr std::size_t frame_floats = 12;

inline bool is_turned(const Link& inner) { return (inner.first & 1) != 0; }
/// Where an inner node begins in memory, in floats.
inline std::size_t place_of(const Link& inner) { return std::size_t{inner.first >> 1} * oriented_unit; }

/// Turns the children's boxes of every node where that leaves less than `area` of their surface. A null mesh, of a
/// level above: nothing is turned. O(n log n) for trees of usual depth.
OrientedNodes encode_oriented(const Tree& tree, const Mesh* mesh, std::uint32_t k, float area);

/// The fastest kernels this machine can run.
Kernels<OrientedNodes, TriangleLeaves> oriented_triangle_kernels(const TraceOptions& options);
Kernels<OrientedNodes, InstanceLeaves> oriented_instance_kernels(const TraceOptions& options);

}  // namespace boxwood
