#include "build/morton/radix_sort.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>
#include <tbb/parallel_reduce.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <array>
#include <bit>
#include <functional>
#include <span>
#include <utility>
#include <vector>

namespace boxwood {
namespace {

constexpr unsigned digit_bits = 10;
constexpr std::size_t digits = std::size_t{1} << digit_bits;
/// Keys per task: enough for its histogram not to count, and few tasks, whose keys of one digit share cache lines with
/// those of the next. Where keys go does not depend on it.
std::size_t chunk_size(std::size_t keys) {
  constexpr std::size_t least = std::size_t{1} << 13;
  const auto tasks = 2 * static_cast<std::size_t>(tbb::this_task_arena::max_concurrency());
  return std::max(least, (keys + tasks - 1) / tasks);
}

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

bool sort_by_digit(std::span<const std::uint64_t> from, std::span<std::uint64_t> to, unsigned shift, std::size_t size,
                   std::vector<Histogram>& chunks) {
  const auto for_chunks = [&](auto&& body) {
    tbb::parallel_for(std::size_t{0}, chunks.size(), [&](std::size_t c) {
      const std::size_t begin = c * size;
      body(chunks[c], from.subspan(begin, std::min(size, from.size() - begin)));
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

/// All bits that are set in any key.
std::uint64_t used_bits(std::span<const std::uint64_t> keys) {
  return tbb::parallel_reduce(
      tbb::blocked_range<std::size_t>(0, keys.size(), 1 << 14), std::uint64_t{0},
      [&](const tbb::blocked_range<std::size_t>& range, std::uint64_t bits) {
        for (std::size_t i = range.begin(); i < range.end(); ++i) bits |= keys[i];
        return bits;
      },
      std::bit_or<>());
}

}  // namespace

void radix_sort(RawArray<std::uint64_t>& keys, unsigned first_bit) {
  const auto end_bit = static_cast<unsigned>(std::bit_width(used_bits(keys)));
  RawArray<std::uint64_t> other(keys.size());
  const std::size_t size = chunk_size(keys.size());
  std::vector<Histogram> chunks((keys.size() + size - 1) / size);
  for (unsigned shift = first_bit; shift < end_bit; shift += digit_bits) {
    if (sort_by_digit(keys, other, shift, size, chunks)) std::swap(keys, other);
  }
}

}  // namespace boxwood
