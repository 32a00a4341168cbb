#include "math/large_memory.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <numeric>
#include <thread>

namespace boxwood {
namespace {

TEST(LargeMemory, AnySize_AlignedToHugePages) {
  for (const std::size_t bytes : {large_bytes, large_bytes + 1, 5 * large_bytes, std::size_t{33} << 20}) {
    void* memory = allocate_large(bytes);
    EXPECT_EQ(reinterpret_cast<std::uintptr_t>(memory) % (std::size_t{2} << 20), 0u) << bytes;
    static_cast<std::byte*>(memory)[bytes - 1] = std::byte{1};
    free_large(memory);
  }
}

/// Blocks of many sizes, freed in another order than they were made and made again: none may lie in another.
TEST(LargeMemory, BlocksInUse_AreDisjoint) {
  std::vector<LargeVector<std::uint64_t>> blocks;
  for (std::uint64_t round = 0; round < 4; ++round) {
    for (std::uint64_t i = 0; i < 8; ++i) {
      blocks.emplace_back((large_bytes / 8) * (1 + (i * 5 + round * 3) % 7), i + 100 * round);
    }
    for (std::size_t b = 0; b < blocks.size(); ++b) {
      const std::uint64_t mark = blocks[b].front();
      for (const std::uint64_t value : blocks[b]) ASSERT_EQ(value, mark);
    }
    for (std::size_t b = 0; b < blocks.size(); b += 2) blocks[b] = LargeVector<std::uint64_t>(1, 7 + b);
    void* other = allocate_large(large_bytes);
    std::fill_n(static_cast<std::byte*>(other), large_bytes, std::byte{0xff});
    for (const auto& block : blocks) ASSERT_NE(block.front(), ~std::uint64_t{0});
    free_large(other);
  }
}

TEST(LargeVector, GrownAcrossTheThreshold_KeepsItsValues) {
  LargeVector<std::uint32_t> values;
  for (std::uint32_t i = 0; i < 600000; ++i) values.push_back(i);
  for (std::uint32_t i = 0; i < 600000; ++i) ASSERT_EQ(values[i], i);
}

TEST(LargeMemory, ManyThreads_EachKeepsItsOwn) {
  std::vector<std::thread> threads;
  std::vector<int> wrong(4, 0);
  for (std::uint32_t t = 0; t < 4; ++t) {
    threads.emplace_back([t, &wrong] {
      for (std::uint32_t i = 0; i < 20; ++i) {
        const LargeVector<std::uint32_t> values(400000 + 10000 * i, 100 * t + i);
        for (const std::uint32_t value : values) wrong[t] += value != 100 * t + i;
      }
    });
  }
  for (std::thread& thread : threads) thread.join();
  EXPECT_EQ(std::accumulate(wrong.begin(), wrong.end(), 0), 0);
}

}  // namespace
}  // namespace boxwood
