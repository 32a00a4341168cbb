// The layout of turned boxes: what they hold, and that its answers are those of brute force.
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>

#include "layout/oriented/oriented_nodes.h"
#include "support/differential.h"
#include "support/layouts.h"
#include "support/rays.h"
#include "support/scenes.h"

namespace boxwood {
namespace {

constexpr float always = 100;  // turns whatever has an area

Link link_at(const OrientedNodes& nodes, const float* node, std::uint32_t lane) {
  Link link;
  std::memcpy(static_cast<void*>(&link), node + 6 * std::size_t{nodes.k} + 2 * std::size_t{lane}, sizeof link);
  return link;
}

/// Calls visit(node, turned, lane, triangle) for every box of every node and every triangle below it.
template <class Visit>
void for_boxes(const OrientedNodes& nodes, const Tree& tree, const Link& link, std::vector<std::uint32_t>& below,
               const Visit& visit) {
  below.clear();
  if (link.leaf) {
    below.assign(tree.references.begin() + link.first, tree.references.begin() + link.first + link.count);
    return;
  }
  const float* node = nodes.memory.data() + place_of(link);
  std::vector<std::uint32_t> all;
  for (std::uint32_t lane = 0; lane < link.count; ++lane) {
    std::vector<std::uint32_t> under;
    for_boxes(nodes, tree, link_at(nodes, node, lane), under, visit);
    for (const std::uint32_t triangle : under) visit(node, is_turned(link), lane, triangle);
    all.insert(all.end(), under.begin(), under.end());
  }
  below = all;
}

/// Where a point lies along an axis of a node's frame: exact but for the last places of a double.
double along(const OrientedNodes& nodes, const float* node, bool turned, std::size_t axis, const Vec3& p) {
  if (!turned) return p[axis];
  const float* row = node + 8 * std::size_t{nodes.k} + 4 * axis;
  return static_cast<double>(row[0]) * p.x + static_cast<double>(row[1]) * p.y + static_cast<double>(row[2]) * p.z;
}

TEST(OrientedBoxes, HoldEveryCornerOfEveryTriangleBelow) {
  for (const test::NamedScene& named : test::troubled_scenes()) {
    if (!named.scene.single_level()) continue;
    const Mesh& mesh = named.scene.meshes[0];
    for (const std::uint32_t k : {2u, 8u}) {
      const Tree tree = test::split_tree(test::triangle_boxes(mesh), {k, 2, false});
      const OrientedNodes nodes = encode_oriented(tree, &mesh, k, always);
      if (nodes.empty()) continue;
      std::vector<std::uint32_t> below;
      for_boxes(nodes, tree, nodes.root, below,
                [&](const float* node, bool turned, std::uint32_t lane, std::uint32_t t) {
                  for (const std::uint32_t vertex : mesh.triangles[t]) {
                    for (std::size_t axis = 0; axis < 3; ++axis) {
                      const double at = along(nodes, node, turned, axis, mesh.positions[vertex]);
                      ASSERT_LE(node[axis * k + lane], at) << named.name;
                      ASSERT_GE(node[(axis + 3) * k + lane], at) << named.name;
                    }
                  }
                });
    }
  }
}

TEST(OrientedFrames, KeepTheBoundOfTheBoxTest_RowsBelowRootOfThree) {
  const Scene scene = test::soup(400, 0.2f, 3);
  const Tree tree = test::split_tree(test::triangle_boxes(scene.meshes[0]), {2, 2, false});
  const OrientedNodes nodes = encode_oriented(tree, &scene.meshes[0], 2, always);
  EXPECT_GT(nodes.turned_nodes, nodes.inner_nodes / 2);
  std::vector<std::uint32_t> below;
  for_boxes(nodes, tree, nodes.root, below, [&](const float* node, bool turned, std::uint32_t, std::uint32_t) {
    if (!turned) return;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const float* row = node + 16 + 4 * axis;
      ASSERT_LT(std::fabs(row[0]) + std::fabs(row[1]) + std::fabs(row[2]), std::sqrt(3.0f) + 1e-5f);
    }
  });
}

test::LayoutCall oriented(const char* k, const char* area) {
  return test::LayoutCall(oriented_stage()).set("k", k).set("area", area);
}

TEST(Oriented, WithEveryBoxTurned_GivesTheAnswersOfBruteForce) {
  std::uint64_t seed = 900;
  for (const test::NamedScene& named : test::troubled_scenes()) {
    const test::Expected expected(named.scene, test::troubling_rays(named.scene, 400, ++seed));
    for (const char* k : {"2", "4", "16"}) {
      for (const ChildOrder order : {ChildOrder::none, ChildOrder::axis, ChildOrder::near}) {
        for (const bool cull : {true, false}) {
          const auto layout = test::encode_scene(named.scene, oriented(k, "100"), {order, cull});
          test::expect_brute_force_answers(*layout, expected, "oriented over " + named.name);
        }
      }
    }
  }
}

TEST(Oriented, ClosedMeshFarAwayOrOfAnySize_IsNeverLeftFromInside) {
  std::vector<Scene> scenes = {test::sphere(12), test::transformed(test::sphere(10), 1e-6f, {}),
                               test::transformed(test::sphere(10), 1e9f, {}),
                               test::transformed(test::sphere(10), 1, {1000, -2000, 3000})};
  Random random(8);
  for (const Scene& scene : scenes) {
    const auto layout = test::encode_scene(scene, oriented("2", "100"), {});
    const Box box = scene.bounds();
    const Mesh& mesh = scene.meshes[0];
    for (int i = 0; i < 6000; ++i) {
      const Triangle& t = mesh.triangles[random.below(static_cast<std::uint32_t>(mesh.triangles.size()))];
      const Vec3 a = mesh.positions[t[0]], b = mesh.positions[t[1]];
      const Vec3 target = i % 2 ? a : a + (b - a) * random.uniform();
      const Vec3 origin = i % 4 == 0 ? box.center() : box.center() + test::random_point(random, 0.2f * box.extent().x);
      const Ray ray{origin, 0, target - origin};
      ASSERT_TRUE(layout->closest_hit(ray).valid()) << "ray " << i;
      ASSERT_TRUE(layout->any_hit(ray)) << "ray " << i;
    }
  }
}

/// Thin rods along (1, 1, 1), as two triangles each.
Scene diagonal_rods(std::uint32_t count) {
  Random random(12);
  std::vector<Vec3> positions;
  std::vector<Triangle> triangles;
  for (std::uint32_t i = 0; i < count; ++i) {
    const Vec3 from = test::random_point(random, 10), along{8, 8, 8}, across{0.02f, -0.02f, 0};
    const auto first = static_cast<std::uint32_t>(positions.size());
    for (const Vec3& p : {from, from + along, from + across, from + along + across}) positions.push_back(p);
    triangles.push_back({first, first + 1, first + 2});
    triangles.push_back({first + 1, first + 3, first + 2});
  }
  return test::scene_of(std::move(positions), std::move(triangles));
}

std::uint64_t primitive_tests(const Scene& scene, const char* area) {
  const auto layout = test::encode_scene(scene, oriented("2", area), {});
  const std::vector<Ray> rays = test::troubling_rays(scene, 2000, 4);
  std::vector<Hit> hits(rays.size());
  std::vector<RayCounters> counters(rays.size());
  layout->closest_hits_counted(rays, hits, counters);
  RayCounters sum;
  for (const RayCounters& c : counters) sum += c;
  return sum.primitive_tests;
}

TEST(Oriented, OverDiagonalRods_TestsFarFewerTriangles) {
  const Scene scene = diagonal_rods(300);
  EXPECT_LT(primitive_tests(scene, "0.7") * 5, primitive_tests(scene, "0"));
}

TEST(Oriented, OverWallsAlongTheAxes_TurnsHardlyANode) {
  const Scene scene = test::cube(8);
  const Tree tree = test::split_tree(test::triangle_boxes(scene.meshes[0]), {2, 2, false});
  const OrientedNodes nodes = encode_oriented(tree, &scene.meshes[0], 2, 0.7f);
  EXPECT_LT(nodes.turned_nodes * 10, nodes.inner_nodes);  // those around edges and corners of the cube
}

}  // namespace
}  // namespace boxwood
