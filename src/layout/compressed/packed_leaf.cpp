#include "layout/compressed/packed_leaf.h"

#include <algorithm>
#include <bit>

namespace boxwood {
namespace {

/// Of a base, the bits that are kept.
constexpr std::uint32_t kept_of_base = 0xffff0000;
constexpr std::uint32_t most_bits = 31;

/// Appends numbers to a stream of bits. The words are zero before.
class BitWriter {
 public:
  explicit BitWriter(std::uint32_t* words) : words_(words) {}

  void put(std::uint32_t value, std::uint32_t bits) {
    if (bits == 0) return;
    const std::uint64_t shifted = std::uint64_t{value} << (at_ % 32);
    words_[at_ / 32] |= static_cast<std::uint32_t>(shifted);
    if (at_ % 32 + bits > 32) words_[at_ / 32 + 1] |= static_cast<std::uint32_t>(shifted >> 32);
    at_ += bits;
  }

 private:
  std::uint32_t* words_;
  std::uint32_t at_ = 0;
};

std::array<std::uint32_t, 3> bits_of_position(const Vec3& p) {
  return {std::bit_cast<std::uint32_t>(p.x), std::bit_cast<std::uint32_t>(p.y), std::bit_cast<std::uint32_t>(p.z)};
}

}  // namespace

std::uint32_t PackedBits::take(std::uint32_t bits) {
  if (bits == 0) return 0;
  std::uint64_t two = words_[at_ / 32];
  if (at_ % 32 + bits > 32) two |= std::uint64_t{words_[at_ / 32 + 1]} << 32;
  const auto value = static_cast<std::uint32_t>(two >> (at_ % 32) & ((std::uint64_t{1} << bits) - 1));
  at_ += bits;
  return value;
}

std::optional<OwnCorners> OwnCorners::of(std::span<const std::uint32_t> names, const Mesh& mesh) {
  if (names.size() > most_packed_triangles) return {};
  OwnCorners leaf;
  leaf.triangles_ = static_cast<std::uint32_t>(names.size());
  std::ranges::copy(names, leaf.names_.begin());
  for (std::size_t i = 0; i < names.size(); ++i) {
    for (std::size_t vertex = 0; vertex < 3; ++vertex) {
      if (!leaf.add_corner(mesh.positions[mesh.triangles[names[i]][vertex]], leaf.index_[vertex][i])) return {};
    }
  }
  if (!leaf.measure()) return {};
  return leaf;
}

bool OwnCorners::add_corner(const Vec3& position, std::uint8_t& index) {
  const auto bits = bits_of_position(position);
  std::uint32_t i = 0;
  while (i < corners_ && (corner_[0][i] != bits[0] || corner_[1][i] != bits[1] || corner_[2][i] != bits[2])) ++i;
  if (i == most_packed_corners) return false;
  for (std::size_t axis = 0; axis < 3; ++axis) corner_[axis][i] = bits[axis];
  corners_ = std::max(corners_, i + 1);
  index = static_cast<std::uint8_t>(i);
  return true;
}

bool OwnCorners::measure() {
  head_ = packed_leaf | (triangles_ - 1) | (corners_ - 1) << 3;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const auto [least, most] = std::minmax_element(corner_[axis].begin(), corner_[axis].begin() + corners_);
    base_[axis] = *least & kept_of_base;
    const auto bits = static_cast<std::uint32_t>(std::bit_width(*most - base_[axis]));
    if (bits > most_bits) return false;
    head_ |= bits << (7 + 5 * axis);
  }
  const auto [least, most] = std::minmax_element(names_.begin(), names_.begin() + triangles_);
  least_name_ = *least;
  head_ |= static_cast<std::uint32_t>(std::bit_width(*most - *least)) << 22;
  return true;
}

void OwnCorners::pack(std::uint32_t* out) const {
  const PackedLeafHead head(head_);
  BitWriter bits(out);
  bits.put(head_, 32);
  bits.put(least_name_, 32);
  for (const std::uint32_t base : base_) bits.put(base >> 16, 16);
  for (const auto& of_vertex : index_) {
    for (std::size_t i = 0; i < triangles_; ++i) bits.put(of_vertex[i], 4);
  }
  for (std::size_t axis = 0; axis < 3; ++axis) {
    for (std::size_t i = 0; i < corners_; ++i) bits.put(corner_[axis][i] - base_[axis], head.bits[axis]);
  }
  for (std::size_t i = 0; i < triangles_; ++i) bits.put(names_[i] - least_name_, head.bits[3]);
}

}  // namespace boxwood
