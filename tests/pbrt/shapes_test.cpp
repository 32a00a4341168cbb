#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

#include "scene/importers/pbrt/loop_subdivision.h"
#include "scene/importers/pbrt/quadrics.h"

namespace boxwood::pbrt {
namespace {

float area_of(const Mesh& mesh) {
  double sum = 0;
  for (const auto& [a, b, c] : mesh.triangles) {
    sum += static_cast<double>(
        length(cross(mesh.positions[b] - mesh.positions[a], mesh.positions[c] - mesh.positions[a])) / 2);
  }
  return static_cast<float>(sum);
}

/// Every edge in one triangle's order is in another's the other way round.
bool is_closed(const Mesh& mesh) {
  std::map<std::pair<std::uint32_t, std::uint32_t>, int> edges;
  for (const Triangle& t : mesh.triangles) {
    for (std::size_t i = 0; i < 3; ++i) {
      const std::uint32_t a = t[i], b = t[(i + 1) % 3];
      // Vertices at a pole are one point.
      const auto key = [&](std::uint32_t v) {
        std::uint32_t first = 0;
        while (mesh.positions[first] != mesh.positions[v]) ++first;
        return first;
      };
      const std::uint32_t from = key(a), to = key(b);
      edges[{std::min(from, to), std::max(from, to)}] += from < to ? 1 : -1;
    }
  }
  return std::ranges::all_of(edges, [](const auto& edge) { return edge.second == 0; });
}

bool faces_away_from(const Mesh& mesh, const Vec3& inside) {
  return std::ranges::all_of(mesh.triangles, [&](const Triangle& t) {
    const Vec3 &a = mesh.positions[t[0]], &b = mesh.positions[t[1]], &c = mesh.positions[t[2]];
    return dot(cross(b - a, c - a), (a + b + c) / 3.0f - inside) > 0;
  });
}

TEST(Quadrics, ASphereIsClosedFacesOutwardAndHasItsArea) {
  const Mesh mesh = sphere(2, -2, 2, 360);
  EXPECT_TRUE(is_closed(mesh));
  EXPECT_TRUE(faces_away_from(mesh, {}));
  for (const Vec3& p : mesh.positions) ASSERT_NEAR(length(p), 2, 1e-5f);
  EXPECT_NEAR(area_of(mesh), 16 * std::numbers::pi_v<float>, 0.3f);
}

TEST(Quadrics, PartsOfASphereHaveTheirShareOfTheArea) {
  const float whole = 4 * std::numbers::pi_v<float>;
  EXPECT_NEAR(area_of(sphere(1, -1, 1, 90)), whole / 4, 0.02f);
  EXPECT_NEAR(area_of(sphere(1, 0, 0.5f, 360)), whole / 4, 0.02f);
}

TEST(Quadrics, OthersHaveTheirAreaAndFront) {
  const float pi = std::numbers::pi_v<float>;
  EXPECT_NEAR(area_of(cylinder(1, -1, 2, 360)), 6 * pi, 0.05f);
  EXPECT_TRUE(faces_away_from(cylinder(1, -1, 2, 360), {0, 0, 0.5f}));
  EXPECT_NEAR(area_of(disk(1, 2, 1, 180)), 1.5f * pi, 0.02f);
  EXPECT_TRUE(faces_away_from(disk(1, 2, 0, 360), {0, 0, 0}));
  EXPECT_NEAR(area_of(cone(2, 1, 360)), pi * std::sqrt(5.0f), 0.05f);
  EXPECT_TRUE(faces_away_from(cone(2, 1, 360), {0, 0, 0.5f}));
  EXPECT_NEAR(area_of(paraboloid(1, 0, 1, 360)), pi / 6 * (std::pow(5.0f, 1.5f) - 1), 0.05f);
}

Mesh octahedron() {
  Mesh mesh;
  mesh.positions = {{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}};
  mesh.triangles = {{0, 2, 4}, {2, 1, 4}, {1, 3, 4}, {3, 0, 4}, {2, 0, 5}, {1, 2, 5}, {3, 1, 5}, {0, 3, 5}};
  return mesh;
}

TEST(LoopSubdivision, QuartersTrianglesAndKeepsAClosedMeshClosed) {
  const Mesh mesh = subdivide(octahedron(), 3);
  EXPECT_EQ(mesh.triangles.size(), 8u * 64);
  EXPECT_EQ(mesh.positions.size(), 258u);
  EXPECT_TRUE(is_closed(mesh));
  EXPECT_TRUE(faces_away_from(mesh, {}));
}

TEST(LoopSubdivision, VerticesLieOnTheLimitSurfaceAtEveryLevel) {
  // A vertex that was there before stays where the limit put it, however often its surroundings are divided.
  const Mesh coarse = subdivide(octahedron(), 1), fine = subdivide(octahedron(), 4);
  for (std::size_t i = 0; i < coarse.positions.size(); ++i) {
    EXPECT_LT(length(coarse.positions[i] - fine.positions[i]), 2e-5f) << i;
  }
}

TEST(LoopSubdivision, AFlatSheetStaysFlatAndKeepsItsStraightBorders) {
  Mesh sheet;
  for (int y = 0; y < 4; ++y) {
    for (int x = 0; x < 4; ++x) sheet.positions.push_back({static_cast<float>(x), static_cast<float>(y), 5});
  }
  for (std::uint32_t y = 0; y < 3; ++y) {
    for (std::uint32_t x = 0; x < 3; ++x) {
      const std::uint32_t a = 4 * y + x;
      sheet.triangles.push_back({a, a + 1, a + 5});
      sheet.triangles.push_back({a, a + 5, a + 4});
    }
  }
  const Mesh mesh = subdivide(sheet, 2);
  for (const Vec3& p : mesh.positions) {
    ASSERT_NEAR(p.z, 5, 1e-5f);
    ASSERT_TRUE(p.x > -1e-5f && p.x < 3 + 1e-5f && p.y > -1e-5f && p.y < 3 + 1e-5f);
  }
}

}  // namespace
}  // namespace boxwood::pbrt
