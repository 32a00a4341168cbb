// Leaves that hold their own corners, packed. Triangles of a leaf share corners, and the corners lie close together:
// what differs in their coordinates' bits is short. Nothing is rounded.
#pragma once
#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

#include "boxwood/scene.h"

namespace boxwood {

/// A packed leaf is a run of 32-bit words, a stream of bits from the lowest of the first word on:
///     0  triangles less one, 3 bits; corners less one, 4 bits
///     7  bits per difference in x, y, z and of a number, 5 bits each
///    27  three bits of zero, 1 for `packed_leaf`, one more of zero
///    32  the least number of a triangle
///    64  the base of x, y, z: the upper 16 bits of a float each
///   112  which corner is the first of each triangle, then which the second, then the third, 4 bits each
///        then of each corner x less its base, as integers; the same of y and z; of each triangle its number less the
///        least
/// Filled up with zeros to whole words.
struct PackedLeafHead {
  std::uint32_t triangles, corners;
  std::uint32_t bits[4];  // of x, y, z, numbers

  explicit constexpr PackedLeafHead(std::uint32_t word)
      : triangles((word & 7) + 1),
        corners((word >> 3 & 15) + 1),
        bits{word >> 7 & 31, word >> 12 & 31, word >> 17 & 31, word >> 22 & 31} {}

  static constexpr std::uint32_t begin_of_indices = 112;
  constexpr std::uint32_t begin_of_corners() const { return begin_of_indices + 12 * triangles; }
  constexpr std::uint32_t begin_of_numbers() const {
    return begin_of_corners() + corners * (bits[0] + bits[1] + bits[2]);
  }
  constexpr std::uint32_t words() const { return (begin_of_numbers() + triangles * bits[3] + 31) / 32; }
};

inline constexpr std::uint32_t most_packed_triangles = 8, most_packed_corners = 16;

/// Set in the first word of a packed leaf; in no name of a triangle.
inline constexpr std::uint32_t packed_leaf = 1u << 30;

/// Kernels read up to this many words from the end of a packed leaf on.
inline constexpr std::size_t words_at_once = 17;

/// A leaf with its own corners.
class OwnCorners {
 public:
  /// Of the triangles that `names` says. Nothing when they are more than a packed leaf can hold, or have more corners,
  /// or corners whose bits differ in too many places, as on both sides of 0.
  static std::optional<OwnCorners> of(std::span<const std::uint32_t> names, const Mesh& mesh);

  std::size_t words() const { return PackedLeafHead(head_).words(); }
  /// Writes words(), which are zero, at `out`.
  void pack(std::uint32_t* out) const;

 private:
  bool add_corner(const Vec3& position, std::uint8_t& index);
  bool measure();

  std::uint32_t head_ = 0, triangles_ = 0, corners_ = 0, least_name_ = 0;
  std::array<std::uint32_t, most_packed_triangles> names_{};
  std::array<std::array<std::uint8_t, most_packed_triangles>, 3> index_{};
  std::array<std::array<std::uint32_t, most_packed_corners>, 3> corner_{};  // bits of x, y, z
  std::array<std::uint32_t, 3> base_{};
};

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
