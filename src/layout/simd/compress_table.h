#pragma once
#include <array>
#include <cstddef>
#include <cstdint>

namespace boxwood {

constexpr std::array<std::array<std::uint8_t, 8>, 256> make_compress_table() {
  std::array<std::array<std::uint8_t, 8>, 256> table{};
  for (std::size_t bits = 0; bits < 256; ++bits) {
    std::size_t count = 0;
    for (std::uint8_t lane = 0; lane < 8; ++lane) {
      if ((bits >> lane & 1) != 0) table[bits][count++] = lane;
    }
  }
  return table;
}

/// compress_table[bits][i]: number of the i-th lowest bit set in `bits`. 2 KiB.
alignas(64) inline constexpr auto compress_table = make_compress_table();

}  // namespace boxwood
