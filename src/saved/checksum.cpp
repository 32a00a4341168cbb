#include "saved/checksum.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <bit>
#include <cstring>
#include <vector>

#include "math/random.h"

namespace boxwood {
namespace {

constexpr std::size_t block_size = std::size_t{1} << 20;
constexpr std::uint64_t factor = 0x9e3779b97f4a7c15u;

std::uint64_t step(std::uint64_t state, std::uint64_t word) { return (std::rotl(state, 23) ^ word) * factor; }

std::uint64_t checksum_of_block(std::span<const std::byte> bytes) {
  constexpr std::size_t lanes = 4, stripe = lanes * sizeof(std::uint64_t);
  std::uint64_t state[lanes] = {1, 2, 3, 4};
  const std::byte* at = bytes.data();
  std::size_t left = bytes.size();
  for (; left >= stripe; at += stripe, left -= stripe) {
    std::uint64_t words[lanes];
    std::memcpy(words, at, stripe);
    for (std::size_t lane = 0; lane < lanes; ++lane) state[lane] = step(state[lane], words[lane]);
  }
  std::uint64_t sum = bytes.size();
  for (const std::uint64_t lane : state) sum = step(sum, lane);
  for (; left > 0; at += std::min<std::size_t>(left, 8), left -= std::min<std::size_t>(left, 8)) {
    std::uint64_t word = 0;
    std::memcpy(&word, at, std::min<std::size_t>(left, 8));
    sum = step(sum, word);
  }
  return sum;
}

}  // namespace

std::uint64_t block_checksum(std::span<const std::byte> bytes) {
  const std::size_t blocks = (bytes.size() + block_size - 1) / block_size;
  if (blocks <= 1) return mix_bits(checksum_of_block(bytes));
  std::vector<std::uint64_t> sums(blocks);
  tbb::parallel_for(std::size_t{0}, blocks, [&](std::size_t block) {
    const std::size_t begin = block * block_size;
    sums[block] = checksum_of_block(bytes.subspan(begin, std::min(block_size, bytes.size() - begin)));
  });
  return mix_bits(checksum_of_block(std::as_bytes(std::span(sums))));
}

}  // namespace boxwood
