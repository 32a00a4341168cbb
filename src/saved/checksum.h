#pragma once
#include <cstddef>
#include <cstdint>
#include <span>

namespace boxwood {

/// A 64-bit checksum as fast as memory: four lanes of words per block of 1 MiB, blocks in parallel. Every step is a
/// bijection of what came before, so no change within one word goes unseen; of other changes one in 2^64 does. Depends
/// on the length. Not for secrets. Runs in the caller's TBB arena; O(bytes).
std::uint64_t block_checksum(std::span<const std::byte> bytes);

}  // namespace boxwood
