#pragma once
#include <cstdint>
#include <vector>

#include "layout/aligned_vector.h"
#include "layout/kernel_layout.h"
#include "layout/octree/octree_head.h"

namespace boxwood {

/// An octree of 32-bit nodes (spec 004, section 2.2.1). One node:
///   bit  0       1: inner node, 0: leaf
///   bits 1…31    number of the first of its eight children, or of its first reference; all ones: a leaf with none
/// The root is node 0. Siblings follow each other in octant order from a multiple of 8 on, in half a cache line.
struct OctreeNodes {
  static constexpr std::uint32_t empty_leaf = 0xfffffffe;

  OctreeHead head;
  AlignedVector<std::uint32_t> words;
  std::vector<std::uint32_t> sizes;  ///< [n] = references of leaf n; read at leaves only

  std::size_t topology_bytes() const { return words.size() * sizeof(std::uint32_t); }
  std::size_t bytes() const { return topology_bytes() + sizes.size() * sizeof(std::uint32_t) + head.reference_bytes(); }
  std::vector<LayoutFact> facts() const {
    std::vector<LayoutFact> facts;
    head.add_facts(facts);
    return facts;
  }
};

/// The fastest kernels this machine can run.
Kernels<OctreeNodes, TriangleLeaves> octree_triangle_kernels();
Kernels<OctreeNodes, InstanceLeaves> octree_instance_kernels();

}  // namespace boxwood
