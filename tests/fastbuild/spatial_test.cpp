#include <gtest/gtest.h>

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
                                     "spatial(alpha=0, budget=2) > optimal-collapse(8)"}) {
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
