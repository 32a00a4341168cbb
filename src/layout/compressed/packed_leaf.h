// Leaves that hold their own corners, packed. Triangles of a leaf share corners, and the corners lie close together:
// what differs in their coordinates' bits is short. Nothing is rounded.
#pragma once
#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
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
///     4  bits per difference in x, y, z, 5 each: up to 25, or 31 for 32 bits; of a number, 5
///    24  bytes that hold numbers, 5 bits; a zero
///    30  1 for `packed_leaf`; 1 when more triangles of the leaf follow, packed likewise
///    32  the number of the first triangle, which is the least
///    64  which corner is the first of each triangle, eight times 4 bits; of missing ones 0; then the second, the third
///   160  the base of x, y, z: the upper halves of words of which the 16 bits before are the lower ones
///   208  of each triangle a bit: whether its number is one more than that of the one before; of missing ones 1
///   216  of each triangle where it is not, but the first, its number less the least one
///        from the next whole byte on, of each corner x less its base, modulo 2^32; from the next the same of y; of z
/// Filled up with zeros to whole words.
struct PackedLeafHead {
  std::uint32_t corners;
  std::uint32_t bits[4];  // of x, y, z, numbers
  std::uint32_t bytes_of_numbers;

  explicit constexpr PackedLeafHead(std::uint32_t word)
      : corners((word & 15) + 1),
        bits{bits_of_code(word >> begin_of_codes & 31), bits_of_code(word >> 9 & 31), bits_of_code(word >> 14 & 31),
             word >> begin_of_width & 31},
        bytes_of_numbers(word >> begin_of_size & 31) {}

  static constexpr std::uint32_t begin_of_codes = 4, begin_of_width = 19, begin_of_size = 24, zeros = 1u << 29;
  static constexpr std::uint32_t begin_of_indices = 64, begin_of_bases = 160, begin_of_joined = 208,
                                 begin_of_numbers = 216;

  /// A register of 64 bytes has the bytes that any one of numbers so wide is in; wider ones take whole words.
  static constexpr std::uint32_t most_bits = 25, code_of_words = 31;
  static constexpr std::uint32_t bits_of_code(std::uint32_t code) { return code + (code + 1) / 32; }
  static constexpr std::uint32_t bytes_of(std::uint32_t count, std::uint32_t bits) { return (count * bits + 7) / 8; }
  constexpr std::uint32_t words() const {
    std::uint32_t bytes = begin_of_numbers / 8 + bytes_of_numbers;
    for (std::uint32_t axis = 0; axis < 3; ++axis) bytes += bytes_of(corners, bits[axis]);
    return (bytes + 3) / 4;
  }
};

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
  OwnCorners(std::span<const std::uint32_t> names, const Mesh& mesh);

  std::size_t triangles() const { return triangles_; }
  std::size_t words() const { return PackedLeafHead(head()).words(); }
  /// Writes words(), which are zero, at `out`.
  void pack(std::uint32_t* out, bool more) const;

 private:
  bool add(std::uint32_t name, const Mesh& mesh);
  void measure_corners();
  void measure_numbers();
  std::uint32_t head() const;

  std::uint32_t triangles_ = 0, corners_ = 0;
  std::array<std::uint32_t, most_packed_triangles> names_{};
  std::array<std::array<std::uint8_t, most_packed_triangles>, 3> index_{};
  std::array<std::array<std::uint32_t, most_packed_corners>, 3> corner_{};  // bits of x, y, z
  std::array<std::uint32_t, 3> base_{};                                     // of x, y, z
  std::array<std::uint32_t, 3> code_{};                                     // of their widths, as the head has them
  std::uint32_t joined_ = 0, number_bits_ = 0;
};

/// Larger leaves name their triangles: a walk passes over one packed part after the other.
inline constexpr std::size_t most_triangles_in_parts = 16;

/// Calls use(triangles with their corners, whether more follow) for all parts of a leaf of up to so many triangles.
template <class Use>
void for_each_packed(std::span<const std::uint32_t> of_leaf, const Mesh& mesh, const Use& use) {
  std::array<std::uint32_t, most_triangles_in_parts> ascending;
  std::ranges::copy(of_leaf, ascending.begin());
  auto names = std::span(ascending).first(of_leaf.size());
  std::ranges::sort(names);
  while (!names.empty()) {
    const OwnCorners part(names, mesh);
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
