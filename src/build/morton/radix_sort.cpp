#include "build/morton/radix_sort.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <bit>
#include <functional>
#include <numeric>
#include <vector>

namespace boxwood {
namespace {

constexpr unsigned digit_bits = 10;
constexpr std::size_t digits = std::size_t{1} << digit_bits;
/// Keys per task. A fixed number, so that the places of the keys depend on nothing else.
constexpr std::size_t chunk_size = std::size_t{1} << 17;

using Histogram = std::array<std::uint32_t, digits>;

std::size_t digit(std::uint64_t key, unsigned shift) { return (key >> shift) & (digits - 1); }

/// Turns counts per chunk and digit into the place of the first key of that digit of that chunk. False when all keys
/// share one digit, so that the pass would change nothing.
bool to_offsets(std::vector<Histogram>& chunks, std::size_t keys) {
  std::uint32_t next = 0;
  for (std::size_t d = 0; d < digits; ++d) {
    const std::uint32_t begin = next;
    for (Histogram& chunk : chunks) next += std::exchange(chunk[d], next);
    if (next - begin == keys) return false;
  }
  return true;
}

bool sort_by_digit(std::span<const std::uint64_t> from, std::span<std::uint64_t> to, unsigned shift,
                   std::vector<Histogram>& chunks) {
  const auto for_chunks = [&](auto&& body) {
    tbb::parallel_for(std::size_t{0}, chunks.size(), [&](std::size_t c) {
      const std::size_t begin = c * chunk_size;
      body(chunks[c], from.subspan(begin, std::min(chunk_size, from.size() - begin)));
    });
  };
  for_chunks([&](Histogram& counts, std::span<const std::uint64_t> keys) {
    counts.fill(0);
    for (const std::uint64_t key : keys) ++counts[digit(key, shift)];
  });
  if (!to_offsets(chunks, from.size())) return false;
  for_chunks([&](Histogram& next, std::span<const std::uint64_t> keys) {
    for (const std::uint64_t key : keys) to[next[digit(key, shift)]++] = key;
  });
  return true;
}

}  // namespace

void radix_sort(std::span<std::uint64_t> keys, std::span<std::uint64_t> scratch, unsigned first_bit) {
  const std::uint64_t used = std::reduce(keys.begin(), keys.end(), std::uint64_t{0}, std::bit_or<>());
  std::vector<Histogram> chunks((keys.size() + chunk_size - 1) / chunk_size);
  std::span<std::uint64_t> from = keys, to = scratch;
  for (unsigned shift = first_bit; shift < static_cast<unsigned>(std::bit_width(used)); shift += digit_bits) {
    if (sort_by_digit(from, to, shift, chunks)) std::swap(from, to);
  }
  if (from.data() != keys.data()) std::copy(from.begin(), from.end(), keys.begin());
}

}  // namespace boxwood
