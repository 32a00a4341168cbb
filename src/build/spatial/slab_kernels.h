#pragma once
#include <array>
#include <cstdint>
#include <span>

#include "build/bin_kernels.h"
#include "build/build_input.h"

namespace boxwood {

inline constexpr std::uint32_t max_slabs = max_bins_in_rows;
/// Floats that may be read or written beyond the last slab.
inline constexpr std::uint32_t slab_padding = 8;

/// Equal slabs along one axis.
struct SlabAxis {
  std::int32_t axis = 0;
  std::uint32_t slabs = 0;
  float origin = 0, scale = 0, last = 0;                  ///< as in BinScale
  std::array<float, max_slabs + slab_padding> borders{};  ///< borders[s]: where slab s begins; slabs + 1 of them

  std::uint32_t slab(float at) const {
    const float bin = (at - origin) * scale;
    return static_cast<std::uint32_t>(static_cast<std::int32_t>(bin < last ? (bin > 0 ? bin : 0) : last));
  }
};

/// What references have in each slab.
struct SlabContents {
  std::array<Box4, max_slabs> boxes;                ///< around their parts
  std::array<std::uint32_t, max_slabs> begin, end;  ///< how many begin, and how many end there
};

/// Sets what is in the slabs. Triangles are cut at the borders, well enough to price splits; what is split for good is
/// clipped by Geometry::clip(), which rounds outward. O(n), and O(slabs) vectors of work for each that is cut.
void fill_slabs(std::span<const Reference> references, const Geometry& geometry, const SlabAxis& slabs,
                SlabContents& out);

}  // namespace boxwood
