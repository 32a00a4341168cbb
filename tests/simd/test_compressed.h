// Trees laid out in compressed nodes, of whatever leaves.
#pragma once
#include <cstdint>
#include <memory>
#include <utility>

#include "layout/compressed/compressed_kernels.h"
#include "layout/compressed/quantized_arena.h"
#include "layout/simd/simd_layout.h"

namespace boxwood {

template <class Node, int N>
std::shared_ptr<const Layout> encode_compressed_in(const Tree& tree, const Mesh& mesh, std::size_t bytes, bool large) {
  QuantizedArena arena = encode_quantized<Node>(tree, mesh, bytes);
  arena.view.out_of_cache = arena.view.out_of_cache || large;
  return std::make_shared<SimdLayout<QuantizedArena>>(std::move(arena), compressed_kernels<N>());
}

/// `width`: 8 or 16. `large`: kernels are told that it does not fit into the cache. The mesh must outlive the layout.
inline std::shared_ptr<const Layout> encode_compressed(std::uint32_t width, const Tree& tree, const Mesh& mesh,
                                                       std::size_t bytes = bytes_per_triangle, bool large = false) {
  if (width == 8) return encode_compressed_in<QuantizedNode8, 8>(tree, mesh, bytes, large);
  return encode_compressed_in<QuantizedNode16, 16>(tree, mesh, bytes, large);
}

}  // namespace boxwood
