#include <gtest/gtest.h>

#include <numeric>

#include "build/spatial/presplit.h"
#include "fastbuild/trees.h"

namespace boxwood {
namespace {

TEST(Spatial, AnyBudget_IsKept) {
  for (const Triangles& triangles : troubling_triangles()) {
    for (const float budget : {0.0f, 0.1f, 1.0f}) {
      const Tree tree = build_tree("spatial(alpha=0, unsplit=off, budget=" + std::to_string(budget) + ")", triangles);
      EXPECT_EQ(validate(tree, triangles.boxes()), "") << triangles.name();
      EXPECT_LE(static_cast<double>(tree.references.size()),
                static_cast<double>(triangles.size()) * (1 + double{budget}) + 0.5)
          << triangles.name();
    }
  }
}

TEST(Spatial, Needles_CheaperThanWithoutCuts) {
  const Triangles triangles("needles", needles(800));
  const Tree whole = build_tree("spatial(budget=0)", triangles), cut = build_tree("spatial(budget=1)", triangles);
  EXPECT_GT(cut.references.size(), triangles.size());
  EXPECT_LT(sah_cost(cut), 0.95 * sah_cost(whole));
}

TEST(Spatial, CutNeedles_StayWhollyCovered) {
  // Points on the triangles: each must lie in a leaf that refers to its triangle.
  const Triangles triangles("needles", needles(300));
  for (const std::string pipeline : {"spatial(alpha=0, budget=2)", "spatial(alpha=0, budget=2, unsplit=off) > reinsert",
                                     "spatial(alpha=0, budget=2) > optimal-collapse(8)", "ploc(presplit=2)"}) {
    const Tree tree = build_tree(pipeline, triangles);
    Random random(7);
    for (std::uint32_t i = 0; i < triangles.size(); ++i) {
      for (int sample = 0; sample < 20; ++sample) {
        float u = random.uniform(), v = random.uniform();
        if (u + v > 1) {
          u = 1 - u;
          v = 1 - v;
        }
        const auto& [a, b, c] = triangles[i];
        const Vec3 point = a + (b - a) * u + (c - a) * v;
        const Vec3 slack{1e-5f, 1e-5f, 1e-5f};
        bool covered = false;
        for (const Tree::Node& node : tree.nodes) {
          if (!node.is_leaf()) continue;
          const Box loose{node.bounds.lower - slack, node.bounds.upper + slack};
          const auto first = tree.references.begin() + node.first;
          if (loose.contains({point, point}) && std::find(first, first + node.count, i) != first + node.count) {
            covered = true;
            break;
          }
        }
        EXPECT_TRUE(covered) << pipeline << ", triangle " << i;
      }
    }
  }
}

TEST(Presplit, AnyBudget_IsKeptAndPiecesLieInTheirTriangle) {
  for (const Triangles& triangles : troubling_triangles()) {
    const std::vector<Box> boxes = triangles.boxes();
    for (const float budget : {0.0f, 0.2f, 3.0f}) {
      const LargeVector<Reference> pieces = presplit(triangles.input().references, triangles, budget);
      EXPECT_LE(static_cast<double>(pieces.size()), static_cast<double>(triangles.size()) * (1 + double{budget}));
      for (const Reference& piece : pieces) EXPECT_TRUE(boxes[piece.primitive].contains(piece.box()));
    }
  }
}

TEST(Presplit, LongTrianglesAmongSmall_OnlyTheyAreCut) {
  std::vector<Corners> all = scattered(1000, 0.02f);
  for (const Corners& needle : needles(20)) all.push_back(needle);
  const Triangles triangles("mixed", all);
  std::vector<int> pieces(all.size());
  for (const Reference& piece : presplit(triangles.input().references, triangles, 0.3f)) ++pieces[piece.primitive];
  for (std::size_t i = 0; i < 1000; ++i) EXPECT_EQ(pieces[i], 1);
  EXPECT_GT(std::accumulate(pieces.begin() + 1000, pieces.end(), 0), 40);
}

TEST(Spatial, BoxesOnly_SplitsReferencesOnly) {
  const Triangles triangles("needles", needles(300));
  BuildInput input = triangles.input();
  input.geometry = nullptr;
  const Stage stage = spatial_stage();
  const Tree tree = stage.build(stage.defaults, std::move(input));
  EXPECT_EQ(validate(tree, triangles.boxes()), "");
  EXPECT_FALSE(tree.clipped_leaves);
  EXPECT_EQ(tree.references.size(), triangles.size());
}

}  // namespace
}  // namespace boxwood
