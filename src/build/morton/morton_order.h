#pragma once
#include <cstdint>
#include <span>

#include "build/build_input.h"
#include "math/large_memory.h"

namespace boxwood {

/// References sorted along the Morton curve: each key is the Morton code of a box's centre, followed by the reference's
/// place in the input. Sorting them is sorting along the curve, with ties by place.
struct MortonOrder {
  RawArray<std::uint64_t> keys;  ///< ascending
  unsigned index_bits = 0;       ///< low bits that hold the place
  float area = 0;                ///< half the area of the box of all centres

  std::uint32_t reference(std::size_t i) const {
    return static_cast<std::uint32_t>(keys[i] & ((std::uint64_t{1} << index_bits) - 1));
  }
  std::uint64_t code(std::size_t i) const { return keys[i] >> index_bits; }
  /// Where the Morton tree splits [begin, end): at the change of the first bit in which the codes differ, or in the
  /// middle when they are all the same. At least two references. O(log n).
  std::size_t split(std::size_t begin, std::size_t end) const;
};

/// Plain interleaved codes (Morton 1966) on a grid of cubes over the boxes' centres, with `code_bits` bits, or as many
/// as fit into 64 beside the place. Parallel, O(n), 16 bytes per reference while it runs and 8 after.
MortonOrder morton_order(std::span<const Reference> references, unsigned code_bits);

}  // namespace boxwood
