// What the SIMD layouts hold in memory: wide nodes and blocks of triangles, in one arena.
#pragma once
#include <cstddef>
#include <cstdint>

namespace boxwood {

/// Where a node or a run of leaf blocks lies: the offset from the arena's start in granules of 32 bytes, times two,
/// plus one for a leaf. 31 bits of granules reach 64 GiB. Nodes thus lie at base + 16 * reference, leaves 16 bytes
/// before.
using WideReference = std::uint32_t;

inline constexpr std::size_t wide_granule = 32;
/// The arena's first cache line is empty, so these two never name anything in it.
inline constexpr WideReference wide_nothing = 0;
inline constexpr WideReference wide_finished = 1;

constexpr bool is_leaf(WideReference reference) { return (reference & 1) != 0; }
constexpr std::size_t wide_offset(WideReference reference) { return std::size_t{reference >> 1} * wide_granule; }
constexpr WideReference wide_reference(std::size_t offset, bool leaf) {
  return static_cast<WideReference>(offset / wide_granule * 2 + (leaf ? 1 : 0));
}

/// Lower and upper planes of N children, axis by axis, then where the children are. Empty lanes hold a box whose lower
/// planes are +infinity and upper planes -infinity: no ray meets it, so no mask is needed to skip them. N = 8: 256
/// bytes, four cache lines.
template <int N>
struct alignas(64) WideNode {
  float planes[6][N];  // [2 * axis]: lower, [2 * axis + 1]: upper
  WideReference children[N];
};
static_assert(sizeof(WideNode<4>) == 128);
static_assert(sizeof(WideNode<8>) == 256);
static_assert(sizeof(WideNode<16>) == 448);

/// Up to L triangles of one leaf. Missing ones are a single point, which nothing hits. A leaf of more than L triangles
/// is a run of blocks; all but the last have `more_blocks` set in primitives[0]. L = 4: 160 bytes, 40 per triangle.
template <int L>
struct alignas(32) LeafBlock {
  float vertices[3][3][L];  // [vertex][axis]
  std::uint32_t primitives[L];
};
static_assert(sizeof(LeafBlock<4>) == 160);
static_assert(sizeof(LeafBlock<8>) == 320);

inline constexpr std::uint32_t more_blocks = 1u << 31;

}  // namespace boxwood
