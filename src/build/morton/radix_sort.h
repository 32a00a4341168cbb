#pragma once
#include <cstddef>
#include <cstdint>
#include <span>

namespace boxwood {

/// Sorts `keys` by their bits [first_bit, 64); keys that agree there keep their order. Least significant digit first,
/// parallel, one result for any number of threads. `scratch` has the size of `keys`. O(n) for a fixed number of bits.
void radix_sort(std::span<std::uint64_t> keys, std::span<std::uint64_t> scratch, unsigned first_bit);

}  // namespace boxwood
