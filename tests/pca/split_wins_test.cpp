// How often either kind of cut won in `combined`.
#include "build/pca/split_wins.h"

#include <gtest/gtest.h>
#include <tbb/global_control.h>
#include <tbb/task_arena.h>

#include "stages.h"

namespace boxwood {
namespace {

SplitWins wins_over(const std::vector<Box>& boxes) {
  const LopsidedGeometry geometry(boxes);
  return count_split_wins({}, input_of(boxes, &geometry));
}

/// Small cubes along the line through the origin in `direction`.
std::vector<Box> row_along(const Vec3& direction, std::uint32_t count) {
  std::vector<Box> boxes;
  for (std::uint32_t i = 0; i < count; ++i) {
    const Vec3 middle = direction * static_cast<float>(i);
    boxes.push_back({middle - Vec3{0.1f, 0.1f, 0.1f}, middle + Vec3{0.1f, 0.1f, 0.1f}});
  }
  return boxes;
}

TEST(SplitWins, AreAllNodesOfThreeOrMore) {
  const std::vector<Box> boxes = random_boxes(3000, 0.05f);
  const Tree tree = build_study_tree("combined", boxes);
  std::uint64_t searched = 0;
  for (std::uint32_t i = 0; i < tree.nodes.size(); ++i) {
    searched += !tree.nodes[i].is_leaf() && primitives_below(tree, i).size() > 2;
  }
  const SplitWins wins = wins_over(boxes);
  EXPECT_EQ(wins.classical + wins.principal, searched);
  EXPECT_GT(wins.classical, 0u);
  EXPECT_GT(wins.principal, 0u);
}

TEST(SplitWins, OfBoxesAlongAWorldAxis_AreClassical) {
  const SplitWins wins = wins_over(row_along({1, 0, 0}, 500));
  EXPECT_GT(wins.classical, 100u);
  EXPECT_EQ(wins.principal, 0u);
}

TEST(SplitWins, DoNotDependOnThreads) {
  const std::vector<Box> boxes = random_boxes(100000, 0.01f);
  const tbb::global_control allow(tbb::global_control::max_allowed_parallelism, 4);
  tbb::task_arena one(1), four(4);
  const SplitWins a = one.execute([&] { return wins_over(boxes); });
  const SplitWins b = four.execute([&] { return wins_over(boxes); });
  EXPECT_EQ(a.classical, b.classical);
  EXPECT_EQ(a.principal, b.principal);
}

}  // namespace
}  // namespace boxwood
