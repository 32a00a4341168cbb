// Ranks and chunks of bits: the worked examples of spec 004, and what holds for any tree.
#include <gtest/gtest.h>

#include <map>
#include <vector>

#include "layout/bits/chunk_plan.h"
#include "layout/bits/rank.h"
#include "math/random.h"

namespace boxwood {
namespace {

template <class Word>
void expect_naive_ranks(const std::vector<std::byte>& field, std::uint32_t bits) {
  std::uint32_t ones = 0;
  for (std::uint32_t i = 0; i < bits; ++i) {
    ASSERT_EQ(rank_before<Word>(field.data(), i), ones) << i;
    ones += test_bit(field.data(), i) ? 1 : 0;
  }
}

TEST(Rank, CountsOnesBeforeAnyBitInWordsOfAnySize) {
  Random random(1);
  for (const std::uint32_t bytes : {8u, 24u, 56u, 120u}) {
    std::vector<std::byte> field(bytes + 8);
    for (std::uint32_t i = 0; i < bytes * 8; ++i) {
      if (random.below(3) == 0) set_bit(field.data(), i);
    }
    expect_naive_ranks<std::uint8_t>(field, bytes * 8);
    expect_naive_ranks<std::uint16_t>(field, bytes * 8);
    expect_naive_ranks<std::uint32_t>(field, bytes * 8);
    expect_naive_ranks<std::uint64_t>(field, bytes * 8);
  }
}

/// The tree of spec 004, section 2.3.2: names of inner nodes and their two children.
const std::map<int, std::pair<int, int>> example = {{0, {11, 12}},  {11, {21, 22}}, {12, {23, 24}},
                                                    {22, {31, 32}}, {24, {33, 34}}, {31, {41, 42}}};

ChunkPlan<int> plan_example(std::uint32_t groups) {
  const auto children = [](int node, int(&out)[2]) {
    out[0] = example.at(node).first, out[1] = example.at(node).second;
  };
  return plan_chunks<2>(
      0, children, [](int node) { return example.contains(node); }, keeps_while_room(groups));
}

TEST(ChunkPlan, OfTheWorkedExample_InOneField) {
  const ChunkPlan<int> plan = plan_example(100);
  EXPECT_EQ(plan.nodes, (std::vector<int>{11, 12, 21, 22, 23, 24, 31, 32, 33, 34, 41, 42}));
  EXPECT_EQ(plan.inner, (std::vector<std::uint8_t>{1, 1, 0, 1, 0, 1, 1, 0, 0, 0, 0, 0}));
  EXPECT_EQ(plan.chunks.size(), 1u);
}

TEST(ChunkPlan, OfTheWorkedExample_InChunksOfSixBits) {
  const ChunkPlan<int> plan = plan_example(3);
  ASSERT_EQ(plan.chunks.size(), 3u);
  EXPECT_EQ(plan.inner, (std::vector<std::uint8_t>{1, 1, 0, 1, 0, 1, 1, 0, 0, 0, 0, 0}));
  const auto field = [&](auto member) {
    std::vector<std::uint32_t> out;
    for (const PlannedChunk& chunk : plan.chunks) out.push_back(chunk.*member);
    return out;
  };
  EXPECT_EQ(field(&PlannedChunk::child_chunks), (std::vector<std::uint32_t>{1, 3, 3}));
  EXPECT_EQ(field(&PlannedChunk::first_leaf), (std::vector<std::uint32_t>{0, 2, 5}));
  EXPECT_EQ(field(&PlannedChunk::first_node), (std::vector<std::uint32_t>{0, 6, 10}));
  EXPECT_EQ(plan.kept, (std::vector<std::uint8_t>{1, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 0}));
}

TEST(ChunkPlan, OfALeaf_IsEmpty) {
  const auto plan = plan_chunks<2>(
      5, [](int, int(&)[2]) {}, [](int) { return false; }, keeps_while_room(3));
  EXPECT_TRUE(plan.chunks.empty() && plan.nodes.empty());
}

}  // namespace
}  // namespace boxwood
