#pragma once
#include <cstdint>
#include <span>

#include "build/build_input.h"
#include "build/float4.h"

namespace boxwood {

/// Where a point falls among equal bins: max(min((point - origin) * scale, last), 0), cut to a whole number, per axis.
struct BinScale {
  Float4 origin{}, scale{}, last{};
};

/// A box with its lower corner negated, so that growing it is one maximum. Lanes 3 and 7 are 0.
struct alignas(32) GrownBox {
  float lanes[8];

  Box4 box() const { return {Float4{-lanes[0], -lanes[1], -lanes[2], 0}, Float4{lanes[4], lanes[5], lanes[6], 0}}; }
};

/// The bins of three axes, side by side: that of number b on some axis is at 4 * b + axis. Every fourth is unused.
struct BinRows {
  GrownBox* boxes;
  std::uint32_t* counts;
  std::uint32_t bins;
};
inline constexpr std::uint32_t max_bins_in_rows = 64;

/// Fills the bins: what is in them before does not matter. Bins are chosen by the references' doubled centres. O(n).
void fill_bins(std::span<const Reference> references, const BinScale& scale, const BinRows& rows);

/// The cheapest border between bins: least area times price, where references are tested in blocks of 1 << block_shift
/// at the price of one; of equal ones the first of the lowest axis.
struct BinBorder {
  float cost = Box4::infinity;  ///< infinite: all references are in one bin of each axis
  std::int32_t axis = 0, border = 0;
  Box4 left, right;
  std::uint32_t left_count = 0, right_count = 0;
};
/// At most max_bins_in_rows. O(bins).
BinBorder cheapest_border(const BinRows& rows, std::uint32_t block_shift);

/// Moves those in bins below `border` to the front, the others behind them. Sets the boxes around the doubled centres
/// of either. Returns how many are in front. O(n).
std::size_t divide_at(std::span<Reference> references, const BinScale& scale, std::int32_t axis, std::int32_t border,
                      Box4& front_centers, Box4& back_centers);

}  // namespace boxwood
