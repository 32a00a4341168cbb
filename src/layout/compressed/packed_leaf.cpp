#include "layout/compressed/packed_leaf.h"

#include <algorithm>
#include <bit>
#include <numeric>

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

/// Of so many bits per value, or, where codes say more than bits, of the next that they say.
std::uint32_t code_of(std::uint32_t bits, bool repeats) {
  using Head = PackedLeafHead;
  if (!repeats) return bits <= Head::most_bits ? bits : Head::code_of_words;
  std::uint32_t code = Head::first_repeated;
  while (Head::bits_of_code[code] < bits) ++code;
  return code;
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

OwnCorners::OwnCorners(std::span<const std::uint32_t> names, const Mesh& mesh, bool tight) : tight_(tight) {
  for (const std::uint32_t name : names.first(std::min<std::size_t>(names.size(), most_packed_triangles))) {
    if (!add(name, mesh)) break;
  }
  measure_numbers();
  measure_axes(no_axis);
  const std::size_t axis = tight_ ? most_repeated() : no_axis;
  if (axis == no_axis) return;
  OwnCorners sorted = *this;
  sorted.sort_corners(axis);
  sorted.measure_axes(axis);
  if (sorted.words() < words()) *this = sorted;
}

/// The axis on which corners have the fewest values; none where no value repeats.
std::size_t OwnCorners::most_repeated() const {
  std::size_t out = no_axis;
  std::uint32_t least = corners_;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const auto values = std::span(corner_[axis]).first(corners_);
    std::uint32_t distinct = 0;
    for (std::size_t i = 0; i < values.size(); ++i) {
      distinct += std::count(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(i), values[i]) == 0 ? 1 : 0;
    }
    if (distinct >= least) continue;
    out = axis;
    least = distinct;
  }
  return out;
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

void OwnCorners::measure_numbers() {
  for (std::uint32_t i = 1; i < most_packed_triangles; ++i) {
    if (i >= triangles_ || names_[i] == names_[i - 1] + 1) joined_ |= 1u << i;
  }
  number_bits_ = (static_cast<std::uint32_t>(std::bit_width(names_[triangles_ - 1] - names_[0])) + 3) / 4 * 4;
}

/// The last 16 bits of the indices.
std::uint32_t OwnCorners::end_of_indices() const {
  std::uint64_t stream = 0;
  for (const auto& of_vertex : index_) {
    for (std::size_t i = 0; i < std::size_t{2} * pairs(); ++i) stream = stream >> 4 | std::uint64_t{of_vertex[i]} << 12;
  }
  return static_cast<std::uint32_t>(stream);
}

/// With the values of one axis, by which corners are sorted, or none, kept once.
void OwnCorners::measure_axes(std::size_t repeated) {
  std::uint32_t before = end_of_indices();
  for (std::size_t axis = 0; axis < 3; ++axis) {
    std::array<std::uint32_t, most_packed_corners> kept = corner_[axis];
    auto values = std::span(kept).first(corners_);
    const bool repeats = axis == repeated;
    if (repeats) {
      values = {values.begin(), std::unique(values.begin(), values.end())};
      if (values.front() == 0) values = values.subspan(1);
    }
    const std::uint32_t upper = values.empty() ? 0 : (std::ranges::min(values) - before) & 0xffff0000;
    const std::uint32_t base = upper | before;
    before = upper >> 16;
    std::uint32_t bits = 0;
    for (const std::uint32_t value : values) bits |= value - base;
    const std::uint32_t code = code_of(static_cast<std::uint32_t>(std::bit_width(bits)), repeats);
    const auto count = static_cast<std::uint32_t>(values.size());
    axes_[axis] = {base, code,
                   (repeats ? PackedLeafHead::bytes_of_changes : 0) +
                       PackedLeafHead::bytes_of(count, PackedLeafHead::bits_of_code[code])};
  }
}

void OwnCorners::sort_corners(std::size_t axis) {
  std::array<std::uint8_t, most_packed_corners> order{}, place{};
  std::iota(order.begin(), order.end(), std::uint8_t{0});
  std::ranges::stable_sort(std::span(order).first(corners_), {}, [&](std::uint8_t i) { return corner_[axis][i]; });
  const auto unsorted = corner_;
  for (std::size_t i = 0; i < corners_; ++i) {
    place[order[i]] = static_cast<std::uint8_t>(i);
    for (std::size_t a = 0; a < 3; ++a) corner_[a][i] = unsorted[a][order[i]];
  }
  for (auto& of_vertex : index_) {
    for (std::size_t i = 0; i < triangles_; ++i) of_vertex[i] = place[of_vertex[i]];
  }
}

/// Which corners have another value than the one before.
std::uint32_t OwnCorners::changes(std::size_t axis) const {
  std::uint32_t out = 0, before = 0;
  for (std::size_t i = 0; i < corners_; ++i) {
    out |= (corner_[axis][i] != before ? 1u : 0u) << i;
    before = corner_[axis][i];
  }
  return out;
}

std::uint32_t OwnCorners::head() const {
  using Head = PackedLeafHead;
  std::uint32_t out = packed_leaf | (corners_ - 1) | number_bits_ / 4 << Head::begin_of_width;
  for (std::size_t i = 0; i < 3; ++i) out |= axes_[i].code << (Head::begin_of_codes + 5 * i);
  out |= (pairs() - 1) << Head::begin_of_pairs;
  return out | Head::bytes_of(NumberRuns(joined_).count() - 1, number_bits_) << Head::begin_of_size;
}

std::size_t OwnCorners::words() const {
  std::uint32_t bytes = PackedLeafHead(head()).begin_of_corners();
  for (const Axis& axis : axes_) bytes += axis.bytes;
  return (bytes + 3) / 4;
}

void OwnCorners::pack(std::uint32_t* out, bool more) const {
  const PackedLeafHead h(head());
  BitWriter bits(out);
  bits.put(head() | (more ? packed_more : 0), 32);
  bits.put(names_[0], 32);
  for (const auto& of_vertex : index_) {
    for (std::size_t i = 0; i < std::size_t{2} * h.pairs; ++i) bits.put(of_vertex[i], 4);
  }
  for (const Axis& axis : axes_) bits.put(axis.base >> 16, 16);
  bits.put(joined_, most_packed_triangles);
  for (std::uint32_t i = 1; i < triangles_; ++i) {
    if ((joined_ >> i & 1) == 0) bits.put(names_[i] - names_[0], number_bits_);
  }
  for (std::size_t a = 0; a < 3; ++a) {
    const Axis& axis = axes_[a];
    bits.to_next_byte();
    std::uint32_t kept = ~0u;
    if (PackedLeafHead::repeats(axis.code)) bits.put(kept = changes(a), most_packed_corners);
    for (std::size_t i = 0; i < corners_; ++i) {
      if ((kept >> i & 1) != 0) bits.put(corner_[a][i] - axis.base, PackedLeafHead::bits_of_code[axis.code]);
    }
  }
}

}  // namespace boxwood
