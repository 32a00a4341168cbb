// Trees laid out in compressed nodes, of whatever leaves.
#pragma once
#include <cstdint>
#include <memory>

#include "layout/compressed/compressed_kernels.h"
#include "layout/compressed/quantized_arena.h"
#include "layout/simd/simd_layout.h"

namespace boxwood {

/// `width`: 8 or 16. The mesh must outlive the layout.
inline std::shared_ptr<const Layout> encode_compressed(std::uint32_t width, const Tree& tree, const Mesh& mesh,
                                                       std::size_t bytes = bytes_per_triangle) {
  using Compressed = SimdLayout<QuantizedArena>;
  if (width == 8)
    return std::make_shared<Compressed>(encode_quantized<QuantizedNode8>(tree, mesh, bytes), compressed_kernels<8>());
  return std::make_shared<Compressed>(encode_quantized<QuantizedNode16>(tree, mesh, bytes), compressed_kernels<16>());
}

}  // namespace boxwood
