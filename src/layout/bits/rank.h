#pragma once
#include <hwy/base.h>

#include <cstddef>
#include <cstdint>
#include <cstring>

namespace boxwood {

/// Bit `i` of a field of words, least significant bit first. Little-endian words of any width hold the same bits.
HWY_INLINE bool test_bit(const std::byte* field, std::uint32_t i) {
  return (static_cast<unsigned>(field[i / 8]) >> i % 8 & 1) != 0;
}

inline void set_bit(std::byte* field, std::uint32_t i) { field[i / 8] |= static_cast<std::byte>(1u << i % 8); }

HWY_INLINE std::uint32_t count_ones(std::uint64_t word) {
  return static_cast<std::uint32_t>(__builtin_popcountll(word));
}

/// Ones before bit `i`, counted in words of type Word. One count per word, as spec 004 has it; narrow words
/// are widened first.
template <class Word>
HWY_INLINE std::uint32_t rank_before(const std::byte* field, std::uint32_t i) {
  constexpr std::uint32_t bits = 8 * sizeof(Word);
  std::uint32_t ones = 0;
  Word word;
  for (std::uint32_t w = 0; w < i / bits; ++w) {
    std::memcpy(&word, field + w * sizeof(Word), sizeof word);
    ones += count_ones(word);
  }
  if (i % bits == 0) return ones;
  std::memcpy(&word, field + i / bits * sizeof(Word), sizeof word);
  const auto before = static_cast<Word>(word & ((Word{1} << i % bits) - 1));
  return ones + count_ones(before);
}

}  // namespace boxwood
