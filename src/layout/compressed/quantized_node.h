// Nodes whose children's boxes are rounded outwards to an 8-bit grid. After Ylitie, Karras and Laine 2017, "Efficient
// Incoherent Ray Traversal on GPUs Through Compressed Wide BVHs".
#pragma once
#include <cstdint>

#include "layout/simd/wide_node.h"

namespace boxwood {

/// References in a compressed tree: the place of a node's or a leaf's first 32-bit word times two, plus one for a leaf.
/// Place 0 is never used. A leaf is packed (packed_leaf.h) or the names of its triangles.

/// A plane of a child lies at origin + q * step: exactly the float that fused multiply-add gives, so the encoder knows
/// it, too. Rows as in WideNode. Eight children, 80 bytes:
///    0  planes, 8 bytes a row
///   48  origin, then per axis the exponent of two plus 127
///   63  which children are nodes, one bit each
///   64  references of the first child that is a node and of the first that is a leaf
///   72  per child: distance in words from that; 255: no child
struct alignas(16) QuantizedNode8 {
  std::uint8_t planes[6][8];
  float origin[3];
  std::uint8_t exponent[3];
  std::uint8_t inner;
  WideReference first_node, first_leaf;
  std::uint8_t place[8];
};
static_assert(sizeof(QuantizedNode8) == 80);

/// Sixteen children, 192 bytes, three cache lines. There is room for steps between powers of two, which make boxes
/// tighter: of 16 significant bits, so that 255 of them are a float, too.
struct alignas(64) QuantizedNode16 {
  std::uint8_t planes[6][16];
  float origin[4], step[4];  // the fourth are 0
  WideReference children[16];
};
static_assert(sizeof(QuantizedNode16) == 192);

/// In `place`, and the most words that may lie before the last leaf of a node of eight.
inline constexpr std::uint32_t no_child = 255;

/// Set in the name of a leaf's last primitive.
inline constexpr std::uint32_t last_of_leaf = 1u << 31;

}  // namespace boxwood
