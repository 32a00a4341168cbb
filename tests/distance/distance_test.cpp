// Distances, neighbours and sides against testing every triangle in higher precision by other means.
#include "boxwood/distance.h"

#include <gtest/gtest.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "boxwood/error.h"
#include "math/clip.h"
#include "support/rays.h"
#include "support/scenes.h"

namespace boxwood {
namespace {

using Long = long double;
using Point = std::array<Long, 3>;

Point to_long(const Vec3& p) { return {p.x, p.y, p.z}; }
Point minus(const Point& a, const Point& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }
Long dot(const Point& a, const Point& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
Point cross(const Point& a, const Point& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

/// One placed triangle of a scene, in world space.
struct Placed {
  Point corners[3];
  TriangleName name;
  Vec3 world[3];
  Long orientation;
};

std::vector<Placed> placed_triangles(const Scene& scene) {
  std::vector<Placed> out;
  for (std::uint32_t i = 0; i < scene.instances.size(); ++i) {
    const Instance& instance = scene.instances[i];
    const Mesh& mesh = scene.meshes[instance.mesh];
    for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
      if (!is_usable(mesh, t)) continue;
      Placed placed;
      for (std::size_t c = 0; c < 3; ++c) {
        const Vec3& p = mesh.positions[mesh.triangles[t][c]];
        placed.world[c] = scene.single_level() ? p : instance.object_to_world.point(p);
        placed.corners[c] = to_long(placed.world[c]);
      }
      placed.name = {i, t};
      placed.orientation = instance.object_to_world.determinant() < 0 ? -1 : 1;
      out.push_back(placed);
    }
  }
  return out;
}

/// By the region of the triangle's plane that the point lies over (Ericson 2005).
Long distance_to(const Placed& t, const Vec3& from) {
  const Point p = to_long(from), a = t.corners[0], b = t.corners[1], c = t.corners[2];
  const auto to_segment = [&](const Point& s, const Point& e) {
    const Point d = minus(e, s);
    const Long along = std::clamp<Long>(dot(minus(p, s), d) / dot(d, d), 0, 1);
    const Point q = {s[0] + along * d[0], s[1] + along * d[1], s[2] + along * d[2]};
    return std::sqrt(dot(minus(p, q), minus(p, q)));
  };
  const Point ab = minus(b, a), ac = minus(c, a), ap = minus(p, a), n = cross(ab, ac);
  const Long w = dot(cross(ab, ap), n), v = dot(cross(ap, ac), n), size = dot(n, n);
  if (size > 0 && v >= 0 && w >= 0 && v + w <= size) return std::fabs(dot(ap, n)) / std::sqrt(size);
  Long least = std::numeric_limits<Long>::infinity();
  for (int e = 0; e < 3; ++e) {
    const Point &s = t.corners[e], &o = t.corners[(e + 1) % 3];
    if (dot(minus(o, s), minus(o, s)) > 0) least = std::min(least, to_segment(s, o));
  }
  return least;
}

/// Turns of the surface around the point by solid angles (van Oosterom, Strackee 1983).
Long turns_around(const std::vector<Placed>& triangles, const Vec3& point) {
  Long sum = 0;
  for (const Placed& t : triangles) {
    const Point p = to_long(point), a = minus(t.corners[0], p), b = minus(t.corners[1], p), c = minus(t.corners[2], p);
    const Long la = std::sqrt(dot(a, a)), lb = std::sqrt(dot(b, b)), lc = std::sqrt(dot(c, c));
    const Long divisor = la * lb * lc + dot(a, b) * lc + dot(b, c) * la + dot(c, a) * lb;
    sum += t.orientation * 2 * std::atan2(dot(a, cross(b, c)), divisor);
  }
  return sum / (4 * std::acos(Long{-1}));
}

/// Around the scene, far off, on vertices, between vertices.
std::vector<Vec3> troubling_points(const Scene& scene, std::uint32_t count, std::uint64_t seed) {
  Random random(seed);
  const Box box = test::arena_of(scene);
  std::vector<Vec3> points;
  for (std::uint32_t i = 0; i < count; ++i) {
    const Vec3 vertex = test::some_vertex(scene, random), other = test::some_vertex(scene, random);
    const Vec3 options[] = {test::point_around(box, random, 0.5f), test::point_around(box, random, 20), vertex,
                            vertex + (other - vertex) * random.uniform(), test::jitter(vertex, random)};
    points.push_back(options[i % 5]);
    for (std::size_t axis = 0; axis < 3; ++axis) {
      points.back()[axis] = std::clamp(points.back()[axis], -largest_coordinate, largest_coordinate);
    }
  }
  return points;
}

struct Case {
  test::NamedScene named;
  std::vector<Placed> triangles;
  std::vector<Vec3> points;
  Long tolerance;  ///< what rounding the answer to floats may change
};

const std::vector<Case>& cases() {
  static const std::vector<Case> all = [] {
    std::vector<Case> out;
    for (test::NamedScene& named : test::troubled_scenes()) {
      Case c{std::move(named), {}, {}, 0};
      c.triangles = placed_triangles(c.named.scene);
      c.points = troubling_points(c.named.scene, 40, out.size());
      const Box box = test::arena_of(c.named.scene);
      for (const Vec3& p : {box.lower, box.upper}) {
        for (std::size_t axis = 0; axis < 3; ++axis) {
          c.tolerance = std::max(c.tolerance, std::fabs(Long{p[axis]}) * 0x1p-22L);
        }
      }
      out.push_back(std::move(c));
    }
    return out;
  }();
  return all;
}

std::vector<Long> distances_to(const Case& c, const Vec3& point) {
  std::vector<Long> out;
  for (const Placed& t : c.triangles) out.push_back(distance_to(t, point));
  return out;
}

/// Answers are rounded to floats, and what they come from to doubles.
bool is_close(Long a, Long b, const Case& c) { return std::fabs(a - b) <= c.tolerance * 0x1p-24L + 1e-6L * b; }

TEST(NearestPoint, IsTheOneThatTestingEveryTriangleFinds) {
  for (const Case& c : cases()) {
    const DistanceQueries queries(c.named.scene);
    std::vector<NearestPoint> batch(c.points.size());
    queries.nearest_points(c.points, batch);
    for (std::size_t i = 0; i < c.points.size(); ++i) {
      const NearestPoint found = queries.nearest_point(c.points[i]);
      EXPECT_EQ(found, batch[i]);
      ASSERT_EQ(found.valid(), !c.triangles.empty()) << c.named.name;
      if (!found.valid()) continue;
      const std::vector<Long> distances = distances_to(c, c.points[i]);
      const Long least = *std::ranges::min_element(distances);
      ASSERT_TRUE(is_close(found.distance, least, c)) << c.named.name << " " << found.distance << " " << double(least);
      const auto at = std::ranges::find(c.triangles, TriangleName{found.instance, found.primitive}, &Placed::name);
      ASSERT_NE(at, c.triangles.end());
      EXPECT_TRUE(is_close(distances[static_cast<std::size_t>(at - c.triangles.begin())], least, c)) << c.named.name;
      const Long w = 1 - Long{found.u} - Long{found.v};
      for (std::size_t axis = 0; axis < 3; ++axis) {
        const Long on_triangle =
            w * at->corners[0][axis] + found.u * at->corners[1][axis] + found.v * at->corners[2][axis];
        EXPECT_NEAR(static_cast<double>(on_triangle), double{found.point[axis]}, static_cast<double>(4 * c.tolerance))
            << c.named.name;
      }
    }
  }
}

TEST(NearestTriangles, AreTheFirstInOrderOfDistanceThenNumber) {
  for (const Case& c : cases()) {
    const DistanceQueries queries(c.named.scene);
    constexpr std::size_t k = 7;
    std::vector<NearestPoint> batch(k * c.points.size());
    queries.nearest_triangles(c.points, k, batch);
    for (std::size_t i = 0; i < c.points.size(); ++i) {
      std::vector<NearestPoint> found(k);
      const std::size_t count = queries.nearest_triangles(c.points[i], found);
      ASSERT_EQ(count, std::min(k, c.triangles.size()));
      EXPECT_TRUE(std::equal(found.begin(), found.end(), batch.begin() + static_cast<std::ptrdiff_t>(i * k)));
      std::vector<Long> distances = distances_to(c, c.points[i]);
      std::ranges::sort(distances);
      for (std::size_t n = 0; n < k; ++n) {
        ASSERT_EQ(found[n].valid(), n < count);
        if (n < count) {
          ASSERT_TRUE(is_close(found[n].distance, distances[n], c)) << c.named.name << " " << n;
        }
      }
      if (count > 0) {
        EXPECT_EQ(found[0], queries.nearest_point(c.points[i]));
      }
    }
  }
}

TEST(NearestTriangles, OfCoincidentTriangles_TheSmallestNumbersWin) {
  const DistanceQueries queries(test::coincident(50));
  std::vector<NearestPoint> found(4);
  EXPECT_EQ(queries.nearest_triangles({0.3f, 0.3f, 4}, found), 4u);
  for (std::uint32_t n = 0; n < 4; ++n) EXPECT_EQ(found[n].primitive, n);
}

TEST(NearestPoint, BeyondTheLimit_IsNone) {
  const DistanceQueries queries(test::sphere(8));
  EXPECT_FALSE(queries.nearest_point({5, 0, 0}, 3.9f).valid());
  EXPECT_TRUE(queries.nearest_point({5, 0, 0}, 4.1f).valid());
  std::vector<NearestPoint> found(3);
  EXPECT_EQ(queries.nearest_triangles({5, 0, 0}, found, 3.9f), 0u);
}

TEST(TrianglesWithin, AreAllThatAreNoFarther) {
  for (const Case& c : cases()) {
    const DistanceQueries queries(c.named.scene);
    for (const Vec3& point : c.points) {
      std::vector<Long> distances = distances_to(c, point), sorted = distances;
      std::ranges::sort(sorted);
      const float radius = sorted.empty() ? 1 : static_cast<float>(sorted[sorted.size() / 3] * 1.01L);
      std::vector<TriangleName> surely, maybe;
      for (std::size_t t = 0; t < distances.size(); ++t) {
        const Long slack = 1e-9L * Long{radius} + c.tolerance * 0x1p-24L;
        if (distances[t] <= Long{radius} - slack) surely.push_back(c.triangles[t].name);
        if (distances[t] <= Long{radius} + slack) maybe.push_back(c.triangles[t].name);
      }
      const std::vector<TriangleName> found = queries.triangles_within(point, radius);
      EXPECT_TRUE(std::ranges::is_sorted(found));
      EXPECT_TRUE(std::ranges::includes(found, surely)) << c.named.name;
      EXPECT_TRUE(std::ranges::includes(maybe, found)) << c.named.name;
    }
  }
}

TEST(TrianglesIn, AreThoseWhoseClippedPartIsNotEmpty) {
  for (const Case& c : cases()) {
    const DistanceQueries queries(c.named.scene);
    for (std::size_t i = 0; i + 1 < c.points.size(); ++i) {
      Box box;
      box.grow(c.points[i]);
      box.grow(c.points[i] + (c.points[i + 1] - c.points[i]) * 0.2f);
      std::vector<TriangleName> expected;
      for (const Placed& t : c.triangles) {
        if (!clip_triangle(t.world[0], t.world[1], t.world[2], box).empty()) expected.push_back(t.name);
      }
      // Clipping widens by a few units in the last place, which decides only where they barely touch.
      const std::vector<TriangleName> found = queries.triangles_in(box);
      std::vector<TriangleName> different;
      std::ranges::set_symmetric_difference(found, expected, std::back_inserter(different));
      for (const TriangleName& name : different) {
        const auto at = std::ranges::find(c.triangles, name, &Placed::name);
        const auto size = static_cast<float>(c.tolerance);
        const Box wide{box.lower - Vec3{size, size, size}, box.upper + Vec3{size, size, size}};
        EXPECT_FALSE(clip_triangle(at->world[0], at->world[1], at->world[2], wide).empty()) << c.named.name;
      }
      EXPECT_LE(different.size(), 1 + expected.size() / 4) << c.named.name;
    }
    EXPECT_TRUE(queries.triangles_in({}).empty());
    EXPECT_EQ(queries.triangles_in(c.named.scene.bounds()).size(), c.triangles.size()) << c.named.name;
  }
}

/// A cube whose triangles all show the same side outwards.
Scene solid_cube(std::uint32_t cells) {
  Scene scene = test::cube(cells);
  Mesh& mesh = scene.meshes[0];
  for (Triangle& t : mesh.triangles) {
    const Vec3 &a = mesh.positions[t[0]], &b = mesh.positions[t[1]], &c = mesh.positions[t[2]];
    if (boxwood::dot(boxwood::cross(b - a, c - a), a + b + c) < 0) std::swap(t[1], t[2]);
  }
  return scene;
}

/// Closed surfaces, among them ones with vertices and edges in line with the axes, placed and mirrored ones that
/// overlap.
std::vector<test::NamedScene> closed_scenes() {
  std::vector<test::NamedScene> out;
  out.push_back({"cube", solid_cube(4)});
  out.push_back({"sphere", test::sphere(8)});
  out.push_back({"torus", test::torus(12)});
  out.push_back({"far torus", test::transformed(test::torus(12), 0.01f, {1e4f, -3e3f, 100})});
  out.push_back({"inside out", test::sphere(8)});
  for (Triangle& t : out.back().scene.meshes[0].triangles) std::swap(t[1], t[2]);
  out.push_back({"two", solid_cube(2)});
  out.back().scene.instances.push_back({0, Transform::translate({0.5f, 0.5f, 0.5f}) * Transform::scale({-1, 1, 1})});
  return out;
}

TEST(SignedDistance, HasTheSignOfTheSolidAngle) {
  for (const test::NamedScene& named : closed_scenes()) {
    const DistanceQueries queries(named.scene);
    ASSERT_TRUE(queries.closed()) << named.name;
    const std::vector<Placed> triangles = placed_triangles(named.scene);
    std::vector<Vec3> points = troubling_points(named.scene, 300, 3);
    for (int i = 0; i < 512; ++i) {  // in line with vertices and edges
      points.push_back({float(i % 8) / 4 - 1, float(i / 8 % 8) / 4 - 1, float(i / 64) / 4 - 1});
    }
    std::vector<float> distances(points.size());
    queries.signed_distances(points, distances);
    std::size_t inside = 0;
    for (std::size_t i = 0; i < points.size(); ++i) {
      EXPECT_EQ(distances[i], queries.signed_distance(points[i]));
      EXPECT_EQ(std::fabs(distances[i]), queries.nearest_point(points[i]).distance);
      if (std::fabs(distances[i]) < 1e-9f * (1 + length(points[i]))) continue;  // on the surface
      const bool expected = std::fabs(turns_around(triangles, points[i])) > 0.5L;
      ASSERT_EQ(distances[i] < 0, expected)
          << named.name << " at " << points[i].x << " " << points[i].y << " " << points[i].z << ": " << distances[i];
      ASSERT_EQ(queries.inside(points[i]), expected);
      inside += expected ? 1 : 0;
    }
    EXPECT_GT(inside, 20u) << named.name;
  }
}

TEST(SignedDistance, OfAnOpenSurface_IsRefused) {
  Scene scene = test::sphere(6);
  scene.meshes[0].triangles.erase(scene.meshes[0].triangles.begin() + 30);
  const DistanceQueries queries(scene);
  EXPECT_FALSE(queries.closed());
  EXPECT_THROW(queries.signed_distance({0, 0, 0}), Error);
  EXPECT_THROW(queries.inside({0, 0, 0}), Error);
}

TEST(SignedDistance, TrianglesWithoutArea_KeepASurfaceClosed) {
  Scene scene = solid_cube(1);
  // Cuts an edge in two on one side only; the gap is a triangle without area.
  Mesh& mesh = scene.meshes[0];
  const Triangle cut = mesh.triangles[0];
  const auto middle = static_cast<std::uint32_t>(mesh.positions.size());
  mesh.positions.push_back((mesh.positions[cut[0]] + mesh.positions[cut[1]]) * 0.5f);
  mesh.triangles[0] = {cut[0], middle, cut[2]};
  mesh.triangles.push_back({middle, cut[1], cut[2]});
  EXPECT_FALSE(DistanceQueries(scene).closed());
  mesh.triangles.push_back({cut[0], cut[1], middle});
  const DistanceQueries queries(scene);
  EXPECT_TRUE(queries.closed());
  EXPECT_FLOAT_EQ(queries.signed_distance({0, 0, 0}), -1);
}

TEST(DistanceQueries, HostileInput_HasADefinedAnswer) {
  const DistanceQueries queries(solid_cube(2)), none(test::scene_of({}, {}));
  constexpr float nan = std::numeric_limits<float>::quiet_NaN(), infinity = std::numeric_limits<float>::infinity();
  for (const float bad : {nan, infinity, -infinity, 1e13f}) {
    EXPECT_FALSE(queries.nearest_point({0, bad, 0}).valid());
    EXPECT_TRUE(queries.triangles_within({bad, 0, 0}, 1e30f).empty());
    EXPECT_EQ(queries.signed_distance({0, 0, bad}), infinity);
    EXPECT_FALSE(queries.inside({0, 0, bad}));
  }
  EXPECT_FALSE(none.nearest_point({0, 0, 0}).valid());
  EXPECT_EQ(none.signed_distance({0, 0, 0}), infinity);
  EXPECT_TRUE(none.triangles_in({{-1, -1, -1}, {1, 1, 1}}).empty());
  EXPECT_THROW(queries.nearest_point({0, 0, 0}, -1), UsageError);
  EXPECT_THROW(queries.nearest_point({0, 0, 0}, nan), UsageError);
  EXPECT_THROW(queries.triangles_within({0, 0, 0}, nan), UsageError);
  EXPECT_EQ(queries.triangles_within({0, 0, 0}, infinity).size(), 48u);
  std::vector<Vec3> points(3);
  std::vector<NearestPoint> nearest(4);
  std::vector<float> distances(2);
  EXPECT_THROW(queries.nearest_points(points, nearest), UsageError);
  EXPECT_THROW(queries.nearest_triangles(points, 2, nearest), UsageError);
  EXPECT_THROW(queries.signed_distances(points, distances), UsageError);
}

TEST(DistanceQueries, AnyNumberOfThreads_GivesTheSameAnswers) {
  const Scene scene = test::soup(2000, 0.1f, 8);
  const std::vector<Vec3> points = troubling_points(scene, 2000, 6);
  const auto answers = [&](int threads) {
    std::vector<NearestPoint> nearest(3 * points.size());
    tbb::task_arena(threads).execute([&] { DistanceQueries(scene).nearest_triangles(points, 3, nearest); });
    return nearest;
  };
  EXPECT_EQ(answers(1), answers(4));
}

}  // namespace
}  // namespace boxwood
