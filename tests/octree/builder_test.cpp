// What holds for octrees of any options over any triangles.
#include <gtest/gtest.h>
#include <tbb/global_control.h>
#include <tbb/task_arena.h>

#include <cctype>
#include <set>

#include "boxwood/error.h"
#include "octree/octrees.h"
#include "support/rays.h"
#include "tree/statistics.h"

namespace boxwood {
namespace {

class OctreeOf : public testing::TestWithParam<std::string> {};

TEST_P(OctreeOf, TroublingTriangles_IsValid) {
  for (const test::NamedScene& named : test::troubled_scenes()) {
    for (const Mesh& mesh : named.scene.meshes) {
      const Tree tree = test::octree_of(mesh, GetParam());
      EXPECT_EQ(validate(tree, test::triangle_boxes(mesh), 8), "") << named.name;
      EXPECT_EQ(tree.cells.codes.size(), tree.nodes.size()) << named.name;
    }
  }
}

/// The leaves of `tree` whose closed cells hold `point`.
std::vector<std::uint32_t> leaves_at(const Tree& tree, const Vec3& point) {
  std::vector<std::uint32_t> leaves;
  for (std::uint32_t i = 0; i < tree.nodes.size(); ++i) {
    if (!tree.nodes[i].is_leaf()) continue;
    if (octree_cell(tree.cells.codes[i]).box(tree.cells.grid).contains({point, point})) leaves.push_back(i);
  }
  return leaves;
}

TEST_P(OctreeOf, APointOfATriangle_LiesInALeafThatRefersToIt) {
  Random random(9);
  for (const Scene& scene : {test::soup(60, 0.6f, 4), test::sphere(6), test::cube(3), test::soup(40, 0.5f, 5, 1e6f)}) {
    const Mesh& mesh = scene.meshes[0];
    const Tree tree = test::octree_of(mesh, GetParam());
    for (int i = 0; i < 600; ++i) {
      const std::uint32_t t = random.below(static_cast<std::uint32_t>(mesh.triangles.size()));
      if (!is_usable(mesh, t)) continue;
      const Vec3 a = mesh.positions[mesh.triangles[t][0]], b = mesh.positions[mesh.triangles[t][1]];
      // A vertex, whose coordinates are exact.
      const Vec3 point = random.below(2) ? a : b;
      const std::vector<std::uint32_t> leaves = leaves_at(tree, point);
      EXPECT_FALSE(leaves.empty());
      for (const std::uint32_t leaf : leaves) {
        const auto begin = tree.references.begin() + tree.nodes[leaf].first;
        EXPECT_NE(std::find(begin, begin + tree.nodes[leaf].count, t), begin + tree.nodes[leaf].count);
      }
    }
  }
}

bool same(const Tree& a, const Tree& b) {
  return a.references == b.references && a.cells.codes == b.cells.codes &&
         std::equal(a.nodes.begin(), a.nodes.end(), b.nodes.begin(), b.nodes.end(),
                    [](const Tree::Node& x, const Tree::Node& y) {
                      return x.bounds == y.bounds && x.first == y.first && x.count == y.count && x.leaf == y.leaf;
                    });
}

TEST_P(OctreeOf, AnyNumberOfThreads_IsTheSame) {
  const tbb::global_control more(tbb::global_control::max_allowed_parallelism, 4);
  const Scene scene = test::sphere(70);  // enough for tasks
  Tree one, many;
  tbb::task_arena(1).execute([&] { one = test::octree_of(scene.meshes[0], GetParam()); });
  tbb::task_arena(4).execute([&] { many = test::octree_of(scene.meshes[0], GetParam()); });
  EXPECT_TRUE(same(one, many));
  EXPECT_EQ(validate(many, test::triangle_boxes(scene.meshes[0]), 8), "");
}

INSTANTIATE_TEST_SUITE_P(AnyOptions, OctreeOf, testing::ValuesIn(test::octree_calls()), [](const auto& test) {
  std::string name;
  for (const char c : test.param) name += std::isalnum(static_cast<unsigned char>(c)) ? c : '_';
  return name;
});

/// Edges from the root to the deepest cell.
std::uint32_t deepest(const Tree& tree) {
  std::uint32_t level = 0;
  for (const OctreeCode code : tree.cells.codes) level = std::max(level, octree_level(code));
  return level;
}

TEST(Octree, PrimitiveThreshold_LeavesBelowItAreNotDivided) {
  const Mesh mesh = test::soup(800, 0.05f, 6).meshes[0];
  const Tree tree = test::octree_of(mesh, "octree(primitives=30, multiplication=8)");
  // With no other decider every leaf is below the threshold, and every divided cell was not.
  for (const Tree::Node& node : tree.nodes) {
    if (node.is_leaf()) {
      EXPECT_LT(node.count, 30u);
      continue;
    }
    std::set<std::uint32_t> primitives;
    std::vector<std::uint32_t> stack{static_cast<std::uint32_t>(&node - tree.nodes.data())};
    while (!stack.empty()) {
      const Tree::Node& n = tree.nodes[stack.back()];
      stack.pop_back();
      for (std::uint32_t i = n.first; i < n.first + n.count; ++i) {
        if (n.is_leaf()) primitives.insert(tree.references[i]);
        if (!n.is_leaf()) stack.push_back(i);
      }
    }
    EXPECT_GE(primitives.size(), 30u);
  }
}

TEST(Octree, MultiplicationThreshold_BoundsTheReferences) {
  const Mesh mesh = test::soup(2000, 0.2f, 3).meshes[0];
  std::size_t before = 0;
  for (const char* call : {"octree(multiplication=1.1)", "octree(multiplication=1.6)", "octree(multiplication=2)",
                           "octree(multiplication=3)"}) {
    const std::size_t references = test::octree_of(mesh, call).references.size();
    EXPECT_GE(references, before) << call;
    before = references;
  }
  EXPECT_EQ(test::octree_of(mesh, "octree(multiplication=1)").references.size(), 2000u);
}

TEST(Octree, Depth_IsNeverPassed) {
  const Mesh mesh = test::soup(500, 0.05f, 3).meshes[0];
  for (const std::uint32_t depth : {1u, 2u, 5u}) {
    const Tree tree = test::octree_of(mesh, "octree(decider=depth, primitives=2, depth=" + std::to_string(depth) + ")");
    EXPECT_EQ(deepest(tree), depth);
  }
}

TEST(Octree, ExactOverlap_SavesReferences) {
  const Mesh mesh = test::soup(500, 0.5f, 3).meshes[0];
  const auto references = [&](const char* exact) {
    return test::octree_of(mesh, std::string("octree(decider=depth, depth=3, exact=") + exact + ")").references.size();
  };
  EXPECT_LT(references("on"), references("off") * 3 / 4);
}

TEST(Octree, SurfaceAreaDecider_CostsNoMoreThanAnyThreshold) {
  const Mesh mesh = test::sphere(24).meshes[0];
  // The surface area cost of the cells, each octant entered with probability 1/4, chains of cells included.
  const auto cost = [&](const std::string& call) {
    const Tree tree = test::octree_of(mesh, call);
    double sum = 0;
    std::set<OctreeCode> divided;
    for (std::size_t i = 0; i < tree.nodes.size(); ++i) {
      const OctreeCode code = tree.cells.codes[i];
      if (tree.nodes[i].is_leaf()) sum += tree.nodes[i].count * std::pow(0.25, octree_level(code));
      if (!tree.nodes[i].is_leaf()) divided.insert(code);
      for (OctreeCode above = code >> 3; above != 0; above >>= 3) divided.insert(above);
    }
    for (const OctreeCode code : divided) sum += 4 * std::pow(0.25, octree_level(code));
    return sum;
  };
  const double best = cost("octree(decider=sah, primitives=2, traversal_cost=4)");
  for (const char* call :
       {"octree(primitives=5)", "octree(primitives=20)", "octree(primitives=20, multiplication=3)",
        "octree(primitives=2, multiplication=2.5)", "octree(decider=depth, depth=4, primitives=9)"}) {
    EXPECT_LE(best, cost(call)) << call;
  }
}

TEST(Octree, Budget_StopsTheBuildWithAnErrorThatSaysWhatToDo) {
  const Mesh mesh = test::soup(2000, 1.5f, 3).meshes[0];
  try {
    test::octree_of(mesh, "octree(decider=depth, depth=21, primitives=2, budget=8)");
    FAIL() << "nothing was thrown";
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what()).find("raise primitives"), std::string::npos) << error.what();
  }
}

TEST(Octree, BoxesWithoutGeometry_GoWhereTheyReach) {
  BuildInput input;
  std::vector<Box> boxes;
  Random random(3);
  for (std::uint32_t i = 0; i < 200; ++i) {
    const Vec3 corner = test::random_point(random, 1);
    boxes.push_back({corner, corner + Vec3{0.1f, 0.2f, 0.05f}});
    input.references.push_back({boxes.back().lower, i, boxes.back().upper});
  }
  const StageCall call = test::octree_call("octree(primitives=4)");
  const Tree tree = call.stage->build(call.options, std::move(input));
  EXPECT_EQ(validate(tree, boxes, 8), "");
  EXPECT_GT(tree.nodes.size(), 20u);
}

TEST(OctreeCells, CodesAndCellsAgree) {
  const OctreeGrid grid = octree_grid({{-1, 2, 3}, {1, 4, 9}});
  OctreeCell cell = OctreeCell::root();
  OctreeCode code = octree_root;
  Random random(4);
  for (std::uint32_t level = 1; level <= octree_levels; ++level) {
    const std::uint32_t octant = random.below(8);
    const Box parent = cell.box(grid);
    cell = cell.child(octant);
    code = octree_child(code, octant);
    EXPECT_EQ(octree_level(code), level);
    EXPECT_EQ(octree_octant(code, level), octant);
    EXPECT_EQ(octree_cell(code).box(grid), cell.box(grid));
    EXPECT_TRUE(parent.contains(cell.box(grid)));
  }
  EXPECT_EQ(cell.size, 1.0f);
}

TEST(OctreeCells, GridEnclosesAnyBounds) {
  Random random(5);
  for (int i = 0; i < 2000; ++i) {
    const float scale = std::pow(10.0f, random.uniform(-12, 11));
    const Vec3 center = test::random_point(random, scale * (i % 3 ? 1.0f : 1e4f));
    Vec3 half = test::random_point(random, scale);
    half = max(half, -half);
    if (i % 5 == 0) half.y = 0;
    if (i % 7 == 0) half = {0, 0, 0};
    const Box bounds{center - half, center + half};
    EXPECT_TRUE(OctreeCell::root().box(octree_grid(bounds)).contains(bounds)) << i;
  }
}

}  // namespace
}  // namespace boxwood
