#include "layout/compressed/packed_leaf.h"

#include <algorithm>
#include <bit>

namespace boxwood {
namespace {

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
  void to_next_byte() { at_ = (at_ + 7) / 8 * 8; }

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
  measure_corners();
  measure_numbers();
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

void OwnCorners::measure_corners() {
  // The last four indices.
  std::uint32_t before = 0;
  for (std::size_t i = 4; i < most_packed_triangles; ++i) before |= std::uint32_t{index_[2][i]} << 4 * (i - 4);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const auto values = std::span(corner_[axis]).first(corners_);
    const std::uint32_t upper = (std::ranges::min(values) - before) & 0xffff0000;
    base_[axis] = upper | before;
    before = upper >> 16;
    std::uint32_t bits = 0;
    for (const std::uint32_t value : values) bits |= value - base_[axis];
    const auto width = static_cast<std::uint32_t>(std::bit_width(bits));
    code_[axis] = width <= PackedLeafHead::most_bits ? width : PackedLeafHead::code_of_words;
  }
}

void OwnCorners::measure_numbers() {
  for (std::uint32_t i = 1; i < most_packed_triangles; ++i) {
    if (i >= triangles_ || names_[i] == names_[i - 1] + 1) joined_ |= 1u << i;
  }
  number_bits_ = static_cast<std::uint32_t>(std::bit_width(names_[triangles_ - 1] - names_[0]));
}

std::uint32_t OwnCorners::head() const {
  using Head = PackedLeafHead;
  std::uint32_t out = packed_leaf | (corners_ - 1) | number_bits_ << Head::begin_of_width;
  for (std::size_t i = 0; i < 3; ++i) out |= code_[i] << (Head::begin_of_codes + 5 * i);
  return out | Head::bytes_of(NumberRuns(joined_).count() - 1, number_bits_) << Head::begin_of_size;
}

void OwnCorners::pack(std::uint32_t* out, bool more) const {
  const PackedLeafHead h(head());
  BitWriter bits(out);
  bits.put(head() | (more ? packed_more : 0), 32);
  bits.put(names_[0], 32);
  for (const auto& of_vertex : index_) {
    for (const std::uint8_t index : of_vertex) bits.put(index, 4);
  }
  for (const std::uint32_t base : base_) bits.put(base >> 16, 16);
  bits.put(joined_, most_packed_triangles);
  for (std::uint32_t i = 1; i < triangles_; ++i) {
    if ((joined_ >> i & 1) == 0) bits.put(names_[i] - names_[0], number_bits_);
  }
  for (std::size_t axis = 0; axis < 3; ++axis) {
    bits.to_next_byte();
    for (std::size_t i = 0; i < corners_; ++i) bits.put(corner_[axis][i] - base_[axis], h.bits[axis]);
  }
}

}  // namespace boxwood
