// Leaves that hold their own corners, packed. Triangles of a leaf share corners, and the corners lie close together:
// what differs in their coordinates' bits is short. Nothing is rounded.
#pragma once
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "boxwood/scene.h"

namespace boxwood {

/// A packed leaf, or a part of a larger one, is a run of 32-bit words, a stream of bits from the lowest of the first
/// word on:
///     0  triangles less one, 3 bits; corners less one, 4 bits
///     7  bits per difference in x, y, z, 6 each, and of a number, 5
///    30  1 for `packed_leaf`; 1 when more triangles of the leaf follow, packed likewise
///    32  the least number of a triangle
///    64  which corner is the first of each triangle, eight times 4 bits; of missing ones 0; then the second, the third
///   160  the base of x, y, z: the upper 16 bits of a float each
///   208  of each corner x less its base, as integers; the same of y and z; of each triangle its number less the least
/// Filled up with zeros to whole words.
struct PackedLeafHead {
  std::uint32_t triangles, corners;
  std::uint32_t bits[4];  // of x, y, z, numbers

  explicit constexpr PackedLeafHead(std::uint32_t word)
      : triangles((word & 7) + 1),
        corners((word >> 3 & 15) + 1),
        bits{word >> places[0] & 63, word >> places[1] & 63, word >> places[2] & 63, word >> places[3] & 31} {}

  alignas(16) static constexpr std::uint32_t places[4] = {7, 13, 19, 25};  // of `bits`
  static constexpr std::uint32_t begin_of_indices = 64, begin_of_bases = 160, begin_of_corners = 208;
  constexpr std::uint32_t begin_of_numbers() const {
    return begin_of_corners + corners * (bits[0] + bits[1] + bits[2]);
  }
  constexpr std::uint32_t words() const { return (begin_of_numbers() + triangles * bits[3] + 31) / 32; }
};

inline constexpr std::uint32_t most_packed_triangles = 8, most_packed_corners = 16;

/// Set in the first word of a packed leaf; in no name of a triangle.
inline constexpr std::uint32_t packed_leaf = 1u << 30;
/// Set there when more triangles of the leaf follow.
inline constexpr std::uint32_t packed_more = 1u << 31;

/// Kernels read up to this many words from the end of a packed leaf on.
inline constexpr std::size_t words_at_once = 17;

/// The first triangles of a leaf, with their own corners.
class OwnCorners {
 public:
  /// Of as many of `names`, which are not none, as can be packed together.
  OwnCorners(std::span<const std::uint32_t> names, const Mesh& mesh);

  std::size_t triangles() const { return triangles_; }
  std::size_t words() const { return PackedLeafHead(head()).words(); }
  /// Writes words(), which are zero, at `out`.
  void pack(std::uint32_t* out, bool more) const;

 private:
  bool add(std::uint32_t name, const Mesh& mesh);
  void measure();
  std::uint32_t head() const;

  std::uint32_t triangles_ = 0, corners_ = 0;
  std::array<std::uint32_t, most_packed_triangles> names_{};
  std::array<std::array<std::uint8_t, most_packed_triangles>, 3> index_{};
  std::array<std::array<std::uint32_t, most_packed_corners>, 3> corner_{};  // bits of x, y, z
  std::array<std::uint32_t, 4> base_{}, width_{};                           // of x, y, z, names
};

/// Calls use(triangles with their corners, whether more follow) for all parts of a leaf.
template <class Use>
void for_each_packed(std::span<const std::uint32_t> names, const Mesh& mesh, const Use& use) {
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
