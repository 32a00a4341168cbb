#pragma once
#include <cstdint>

#include "tree/tree.h"

namespace boxwood {

/// A side of a box: 2 * axis, plus 1 for the upper side.
using BoxSide = std::uint32_t;

/// What the five flag bits of a node say. Bits 0-2: the side its plane stands for (0 to 5); bits 3-4: the axis along
/// which its two children ascend, or 3 for a leaf. Of the codes that this leaves free, 6 and 7 in the low bits mark a
/// node whose children are to be visited as stored; the plane's axis is then in bits 3-4.
struct SplitFlags {
  static constexpr std::uint32_t bits = 5;

  static constexpr std::uint32_t leaf(BoxSide side) { return 3u << 3 | side; }
  static constexpr std::uint32_t inner(BoxSide side, std::uint32_t axis, bool fixed_order) {
    return fixed_order ? (side >> 1) << 3 | 6u | (side & 1) : axis << 3 | side;
  }

  std::uint32_t code;
  bool fixed_order() const { return (code & 7) >= 6; }
  bool is_leaf() const { return code >= 3u << 3; }
  std::uint32_t axis() const { return code >> 3 & 3; }
  BoxSide side() const { return fixed_order() ? 2 * axis() + (code & 1) : code & 7; }
};

/// Index and flags in 32 bits: 27 bits of index. A triangle number of a leaf, or the number of an inner node's pair of
/// children.
struct Word32 {
  static constexpr std::uint64_t most_indices = std::uint64_t{1} << (32 - SplitFlags::bits);
  std::uint32_t word = 0;

  Word32() = default;
  Word32(std::uint32_t index, std::uint32_t flags) : word(index << SplitFlags::bits | flags) {}
  std::uint32_t index() const { return word >> SplitFlags::bits; }
  SplitFlags flags() const { return {word & 31}; }
};

/// The same in 64 bits, as two halves so that a node need not be aligned to 8 bytes. Trees count in 32 bits, so the
/// upper part of the 59 bits of index is always 0 and need not be read.
struct Word64 {
  static constexpr std::uint64_t most_indices = std::uint64_t{1} << 32;
  std::uint32_t low = 0, high = 0;

  Word64() = default;
  Word64(std::uint32_t index, std::uint32_t flags)
      : low(index << SplitFlags::bits | flags), high(index >> (32 - SplitFlags::bits)) {}
  std::uint32_t index() const { return low >> SplitFlags::bits | high << (32 - SplitFlags::bits); }
  SplitFlags flags() const { return {low & 31}; }
};

}  // namespace boxwood
