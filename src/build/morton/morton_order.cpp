#include "build/morton/morton_order.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>
#include <tbb/parallel_reduce.h>

#include <algorithm>
#include <bit>
#include <limits>

#include "build/morton/radix_sort.h"

namespace boxwood {
namespace {

using Range = tbb::blocked_range<std::size_t>;
constexpr std::size_t grain = 1 << 13;

Vec3 doubled_center(const Reference& reference) { return reference.lower + reference.upper; }

Box bounds_of_centers(std::span<const Reference> references) {
  return tbb::parallel_reduce(
      Range(0, references.size(), grain), Box{},
      [&](const Range& range, Box box) {
        for (std::size_t i = range.begin(); i < range.end(); ++i) box.grow(doubled_center(references[i]));
        return box;
      },
      [](Box a, const Box& b) { return unite(a, b); });
}

/// Moves bit i of a number below 2^21 to bit 3i.
std::uint64_t spread(std::uint64_t x) {
  x = (x | x << 32) & 0x001f00000000ffff;
  x = (x | x << 16) & 0x001f0000ff0000ff;
  x = (x | x << 8) & 0x100f00f00f00f00f;
  x = (x | x << 4) & 0x10c30c30c30c30c3;
  return (x | x << 2) & 0x1249249249249249;
}

}  // namespace

std::size_t MortonOrder::split(std::size_t begin, std::size_t end) const {
  const std::uint64_t difference = code(begin) ^ code(end - 1);
  if (difference == 0) return begin + (end - begin) / 2;
  const auto low_bits = static_cast<unsigned>(std::bit_width(difference)) - 1;
  const std::uint64_t first_of_right = code(end - 1) >> low_bits << low_bits;
  const std::span<const std::uint64_t> part = std::span<const std::uint64_t>(keys).subspan(begin, end - begin);
  return begin + static_cast<std::size_t>(std::ranges::lower_bound(part, first_of_right << index_bits) - part.begin());
}

MortonOrder morton_order(std::span<const Reference> references, unsigned code_bits) {
  const auto index_bits = static_cast<unsigned>(std::bit_width(references.size()));
  const unsigned axis_bits = std::min({code_bits, 63 - index_bits, 60u}) / 3;
  const Box bounds = bounds_of_centers(references);
  const Vec3 extent = bounds.extent();
  const float size = std::max({extent.x, extent.y, extent.z});
  const auto cells = static_cast<float>(1u << axis_bits);
  // Not infinite for denormal sizes: zero times infinity is no cell.
  const float scale = size > 0 ? std::min(cells / size, std::numeric_limits<float>::max()) : 0;

  MortonOrder order{RawArray<std::uint64_t>(references.size()), index_bits, half_area(bounds) / 4};
  tbb::parallel_for(Range(0, references.size(), grain), [&](const Range& range) {
    const auto cell = [&](float offset) {
      return static_cast<std::uint64_t>(static_cast<std::int64_t>(std::min(offset * scale, cells - 1)));
    };
    for (std::size_t i = range.begin(); i < range.end(); ++i) {
      const Vec3 offset = doubled_center(references[i]) - bounds.lower;
      const std::uint64_t code = spread(cell(offset.x)) << 2 | spread(cell(offset.y)) << 1 | spread(cell(offset.z));
      order.keys[i] = code << index_bits | i;
    }
  });
  radix_sort(order.keys, index_bits);
  return order;
}

}  // namespace boxwood
