#include "math/large_memory.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <numeric>
#include <thread>

#include "boxwood/memory.h"

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

/// More than is kept for later, so that some of it has been given back meanwhile.
TEST(LargeMemory, BlocksFreedAndMadeAgain_HoldWhatIsWritten) {
  constexpr std::size_t each = std::size_t{100} << 20;
  for (std::uint32_t round = 0; round < 3; ++round) {
    std::vector<RawArray<std::uint64_t>> blocks;
    for (std::uint64_t b = 0; b < 3; ++b) {
      blocks.emplace_back(each / 8);
      for (std::size_t i = 0; i < blocks[b].size(); i += 512) blocks[b][i] = b * 1000 + i + round;
    }
    for (std::uint64_t b = 0; b < 3; ++b) {
      for (std::size_t i = 0; i < blocks[b].size(); i += 512) ASSERT_EQ(blocks[b][i], b * 1000 + i + round);
    }
    release_kept_memory();
  }
}

TEST(HeldMemory, AskedForZeros_HoldsThem) {
  for (const std::size_t bytes : {std::size_t{100}, std::size_t{300} << 10, std::size_t{1900} << 10,
                                  std::size_t{2500} << 10, std::size_t{4} << 20, std::size_t{11} << 20}) {
    for (int round = 0; round < 2; ++round) {
      auto* memory = static_cast<std::byte*>(allocate_held(bytes, Holds::zeros));
      ASSERT_NE(memory, nullptr);
      EXPECT_EQ(reinterpret_cast<std::uintptr_t>(memory) % 64, 0u);
      EXPECT_EQ(std::count(memory, memory + bytes, std::byte{0}), static_cast<std::ptrdiff_t>(bytes));
      std::fill_n(memory, bytes, std::byte{0xff});
      free_held(memory, bytes);
    }
  }
}

TEST(LargeVector, Unwritten_IsAnArrayLikeAnyOtherOnceWritten) {
  for (const std::size_t size : {std::size_t{0}, std::size_t{5}, std::size_t{300000}}) {
    LargeVector<std::uint32_t> values = unwritten<std::uint32_t>(size);
    ASSERT_EQ(values.size(), size);
    std::iota(values.begin(), values.end(), 1u);
    values.resize(size + 3);  // as ever: zeros
    for (std::size_t i = 0; i < size; ++i) ASSERT_EQ(values[i], i + 1);
    for (std::size_t i = size; i < size + 3; ++i) EXPECT_EQ(values[i], 0u);
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
