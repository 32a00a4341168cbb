// Leaves that hold their own corners, packed. Triangles of a leaf share corners, and the corners lie close together:
// what differs in their coordinates' bits is short. Nothing is rounded.
#pragma once
#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>

#include "boxwood/scene.h"

namespace boxwood {

inline constexpr std::uint32_t most_packed_triangles = 8, most_packed_corners = 16;

/// Which triangles of a leaf begin a run of numbers that follow one another: bit i for the i-th; bit 0 is set.
struct NumberRuns {
  std::uint32_t firsts;

  /// `joined`: which triangles' numbers are one more than that of the one before, of up to the given triangle.
  explicit constexpr NumberRuns(std::uint32_t joined, std::uint32_t last_triangle = most_packed_triangles - 1)
      : firsts(~joined & ((2u << last_triangle) - 1)) {}
  constexpr std::uint32_t count() const { return static_cast<std::uint32_t>(std::popcount(firsts)); }
  /// The first triangle of the last run.
  constexpr std::uint32_t last() const { return static_cast<std::uint32_t>(std::bit_width(firsts)) - 1; }
};

/// A packed leaf, or a part of a larger one, is a run of 32-bit words, a stream of bits from the lowest of the first
/// word on:
///     0  corners less one, 4 bits
///     4  how x, y, z are kept, a code of 5 bits each
///    19  half-bytes per number of a triangle, 4 bits
///    23  pairs of triangles that have indices less one, 2 bits
///    25  bytes that hold numbers, 5 bits
///    30  1 for `packed_leaf`; 1 when more triangles of the leaf follow, packed likewise
///    32  the number of the first triangle, which is the least
///    64  which corner is the first of each triangle, 4 bits each, a byte per pair; of missing ones 0; then which is
///        the second, the third
///        the base of x, y, z: the upper halves of words of which the 16 bits before are the lower ones
///        of eight triangles a bit each: whether its number is one more than that of the one before; of missing ones 1
///        of each triangle whose number is not one more, but the first, its number less the least one
///        from the next whole byte on, of each corner x less its base, modulo 2^32; from the next the same of y; of z
/// Filled up with zeros to whole words. Codes up to 25 are the bits of a difference; 31 says 32.
///
/// A tight leaf takes less room and longer to unpack. It has indices only of pairs that are there, others have four.
/// The values of one axis may be kept once where they repeat, as heights of blades of grass and coordinates of walls
/// do. Then its code is from 26 on, corners are sorted by it, it begins with a bit for each of 16 corners, whether it
/// has another value than the one before (the first: than zero), and only those other values follow.
struct PackedLeafHead {
  std::uint32_t corners;
  std::uint32_t codes[3];
  std::uint32_t number_bits, pairs;
  std::uint32_t bytes_of_numbers;

  explicit constexpr PackedLeafHead(std::uint32_t word)
      : corners((word & 15) + 1),
        codes{word >> begin_of_codes & 31, word >> (begin_of_codes + 5) & 31, word >> (begin_of_codes + 10) & 31},
        number_bits((word >> begin_of_width & 15) * 4),
        pairs((word >> begin_of_pairs & 3) + 1),
        bytes_of_numbers(word >> begin_of_size & 31) {}

  static constexpr std::uint32_t begin_of_codes = 4, begin_of_width = 19, begin_of_pairs = 23, begin_of_size = 25;
  // In bytes, of leaves that have indices of so many pairs.
  static constexpr std::uint32_t all_pairs = most_packed_triangles / 2, begin_of_indices = 8;
  static constexpr std::uint32_t begin_of_bases(std::uint32_t pairs) { return begin_of_indices + 3 * pairs; }
  static constexpr std::uint32_t begin_of_joined(std::uint32_t pairs) { return begin_of_bases(pairs) + 6; }
  static constexpr std::uint32_t begin_of_numbers(std::uint32_t pairs) { return begin_of_joined(pairs) + 1; }
  constexpr std::uint32_t begin_of_corners() const { return begin_of_numbers(pairs) + bytes_of_numbers; }

  /// A register of 64 bytes has the bytes that any one of numbers so wide is in; wider ones take whole words.
  static constexpr std::uint32_t most_bits = 25, code_of_words = 31;
  static constexpr std::array<std::uint8_t, 32> bits_of_code = {0,  1,  2,  3,  4,  5,  6,  7,  8,  9,  10,
                                                                11, 12, 13, 14, 15, 16, 17, 18, 19, 20, 21,
                                                                22, 23, 24, 25, 22, 23, 24, 25, 32, 32};
  static constexpr std::uint32_t first_repeated = most_bits + 1, bytes_of_changes = 2;
  static constexpr bool repeats(std::uint32_t code) { return code >= first_repeated && code != code_of_words; }
  static constexpr std::uint32_t bytes_of(std::uint32_t count, std::uint32_t bits) { return (count * bits + 7) / 8; }

  /// Of an axis that is kept at `stream`.
  std::uint32_t bytes_of_axis(std::uint32_t code, const std::uint8_t* stream) const {
    if (!repeats(code)) return bytes_of(corners, bits_of_code[code]);
    return bytes_of_changes +
           bytes_of(static_cast<std::uint32_t>(std::popcount(changes_at(stream))), bits_of_code[code]);
  }
  static std::uint32_t changes_at(const std::uint8_t* stream) {
    std::uint16_t changes;
    std::memcpy(&changes, stream, sizeof changes);
    return changes;
  }
};

/// The size of a packed leaf, or of a part of one.
inline std::uint32_t words_of_packed(const std::uint32_t* words) {
  const PackedLeafHead head(words[0]);
  const auto* stream = reinterpret_cast<const std::uint8_t*>(words);
  std::uint32_t bytes = head.begin_of_corners();
  for (const std::uint32_t code : head.codes) bytes += head.bytes_of_axis(code, stream + bytes);
  return (bytes + 3) / 4;
}

/// Set in the first word of a packed leaf; in no name of a triangle.
inline constexpr std::uint32_t packed_leaf = 1u << 30;
/// Set there when more triangles of the leaf follow.
inline constexpr std::uint32_t packed_more = 1u << 31;

/// Kernels read up to this many words from the end of a packed leaf on.
inline constexpr std::size_t words_at_once = 17;

/// The first triangles of a leaf, with their own corners.
class OwnCorners {
 public:
  /// Of as many of `names`, which ascend and are not none, as can be packed together.
  OwnCorners(std::span<const std::uint32_t> names, const Mesh& mesh, bool tight);

  std::size_t triangles() const { return triangles_; }
  std::size_t words() const;
  /// Writes words(), which are zero, at `out`.
  void pack(std::uint32_t* out, bool more) const;

 private:
  struct Axis {
    std::uint32_t base = 0, code = 0, bytes = 0;
  };
  using Axes = std::array<Axis, 3>;
  static constexpr std::size_t no_axis = 3;

  bool add(std::uint32_t name, const Mesh& mesh);
  void measure_numbers();
  std::size_t most_repeated() const;
  void measure_axes(std::size_t repeated);
  void sort_corners(std::size_t axis);
  std::uint32_t pairs() const { return ((tight_ ? triangles_ : most_packed_triangles) + 1) / 2; }
  std::uint32_t end_of_indices() const;
  std::uint32_t changes(std::size_t axis) const;
  std::uint32_t head() const;

  bool tight_;
  std::uint32_t triangles_ = 0, corners_ = 0;
  std::array<std::uint32_t, most_packed_triangles> names_{};
  std::array<std::array<std::uint8_t, most_packed_triangles>, 3> index_{};
  std::array<std::array<std::uint32_t, most_packed_corners>, 3> corner_{};  // bits of x, y, z
  Axes axes_{};
  std::uint32_t joined_ = 0, number_bits_ = 0;
};

/// Larger leaves name their triangles: a walk passes over one packed part after the other.
inline constexpr std::size_t most_triangles_in_parts = 16;

/// Calls use(triangles with their corners, whether more follow) for all parts of a leaf of up to so many triangles.
template <class Use>
void for_each_packed(std::span<const std::uint32_t> of_leaf, const Mesh& mesh, bool tight, const Use& use) {
  std::array<std::uint32_t, most_triangles_in_parts> ascending;
  std::ranges::copy(of_leaf, ascending.begin());
  auto names = std::span(ascending).first(of_leaf.size());
  std::ranges::sort(names);
  while (!names.empty()) {
    const OwnCorners part(names, mesh, tight);
    names = names.subspan(part.triangles());
    use(part, !names.empty());
  }
}

/// The bits of a packed leaf one number after the other, as files are checked.
class PackedBits {
 public:
  PackedBits(const std::uint32_t* words, std::uint32_t begin) : words_(words), at_(begin) {}
  std::uint32_t take(std::uint32_t bits);

 private:
  const std::uint32_t* words_;
  std::uint32_t at_;
};

}  // namespace boxwood
