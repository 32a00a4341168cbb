#include "layout/compressed/packed_leaf.h"

#include <algorithm>
#include <bit>

namespace boxwood {
namespace {

/// Of a base, the bits that are kept.
constexpr std::uint32_t kept_of_base = 0xffff0000;

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

OwnCorners::OwnCorners(std::span<const std::uint32_t> names, const Mesh& mesh) {
  for (const std::uint32_t name : names.first(std::min<std::size_t>(names.size(), most_packed_triangles))) {
    if (!add(name, mesh)) break;
  }
  measure();
}

bool OwnCorners::add(std::uint32_t name, const Mesh& mesh) {
  std::uint32_t size = corners_;
  for (std::size_t vertex = 0; vertex < 3; ++vertex) {
    const auto bits = bits_of_position(mesh.positions[mesh.triangles[name][vertex]]);
    std::uint32_t i = 0;
    while (i < size && (corner_[0][i] != bits[0] || corner_[1][i] != bits[1] || corner_[2][i] != bits[2])) ++i;
    if (i == most_packed_corners) {
      for (auto& of_vertex : index_) of_vertex[triangles_] = 0;
      return false;
    }
    for (std::size_t axis = 0; axis < 3; ++axis) corner_[axis][i] = bits[axis];
    size = std::max(size, i + 1);
    index_[vertex][triangles_] = static_cast<std::uint8_t>(i);
  }
  corners_ = size;
  names_[triangles_++] = name;
  return true;
}

void OwnCorners::measure() {
  const auto set = [&](std::size_t stream, std::span<const std::uint32_t> values, std::uint32_t kept) {
    const auto [least, most] = std::ranges::minmax(values);
    base_[stream] = least & kept;
    width_[stream] = static_cast<std::uint32_t>(std::bit_width(most - base_[stream]));
  };
  for (std::size_t axis = 0; axis < 3; ++axis) set(axis, std::span(corner_[axis]).first(corners_), kept_of_base);
  set(3, std::span(names_).first(triangles_), ~0u);
}

std::uint32_t OwnCorners::head() const {
  std::uint32_t out = packed_leaf | (triangles_ - 1) | (corners_ - 1) << 3;
  for (std::size_t i = 0; i < 4; ++i) out |= width_[i] << PackedLeafHead::places[i];
  return out;
}

void OwnCorners::pack(std::uint32_t* out, bool more) const {
  BitWriter bits(out);
  bits.put(head() | (more ? packed_more : 0), 32);
  bits.put(base_[3], 32);
  for (const auto& of_vertex : index_) {
    for (const std::uint8_t index : of_vertex) bits.put(index, 4);
  }
  for (std::size_t axis = 0; axis < 3; ++axis) bits.put(base_[axis] >> 16, 16);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    for (std::size_t i = 0; i < corners_; ++i) bits.put(corner_[axis][i] - base_[axis], width_[axis]);
  }
  for (std::size_t i = 0; i < triangles_; ++i) bits.put(names_[i] - base_[3], width_[3]);
}

}  // namespace boxwood
