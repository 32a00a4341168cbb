#pragma once
#include <cstdint>

#include "math/large_memory.h"

namespace boxwood {

/// Sorts `keys` by their bits [first_bit, 64); keys that agree there keep their order. Least significant digit first,
/// parallel, one result for any number of threads. O(n) for a fixed number of bits, with an array as large as `keys`.
void radix_sort(RawArray<std::uint64_t>& keys, unsigned first_bit);

}  // namespace boxwood
