// Structures that move: after every update what brute force says of the scene as it is then, to the bit.
#include "boxwood/moving.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "support/differential.h"
#include "support/layout_recipes.h"
#include "support/rays.h"
#include "support/scenes.h"

namespace boxwood {
namespace {

using Positions = std::vector<Vec3>;

/// What one update brings: places of one mesh.
struct Frame {
  std::string name;
  Positions positions;
};

template <class Map>
Frame mapped(std::string name, const Positions& from, const Map& map) {
  Frame frame{std::move(name), {}};
  for (const Vec3& p : from) frame.positions.push_back(map(p));
  return frame;
}

/// Gentle motion, wild motion, and the places where triangles stop being triangles and become some again.
std::vector<Frame> frames_of(const Positions& rest) {
  Random random(7);
  std::vector<Frame> frames;
  frames.push_back(mapped("twist", rest, [](const Vec3& p) {
    const float turn = 0.8f * p.z;
    return Vec3{p.x * std::cos(turn) - p.y * std::sin(turn), p.x * std::sin(turn) + p.y * std::cos(turn), p.z};
  }));
  frames.push_back(mapped("shuffled", rest, [&](const Vec3& p) { return p + test::random_point(random, 1); }));
  frames.push_back(mapped("far away", rest, [](const Vec3& p) { return p * 0.01f + Vec3{3e5f, -1e5f, 7}; }));
  frames.push_back(mapped("flat", rest, [](const Vec3& p) { return Vec3{p.x, p.y, 0.25f}; }));
  frames.push_back(mapped("a line", rest, [](const Vec3& p) { return Vec3{p.x, p.x, p.x}; }));
  frames.push_back(frames.front());
  frames.push_back({"not finite", rest});
  frames.back().positions[3].y = std::numeric_limits<float>::quiet_NaN();
  frames.back().positions[8].x = 2e12f;
  frames.push_back({"back", rest});
  return frames;
}

struct Truth {
  std::string name;
  Scene rest;
  std::vector<Frame> frames;
  std::vector<test::Expected> expected;  // per frame
};

const std::vector<Truth>& truths() {
  static const std::vector<Truth> all = [] {
    std::vector<Truth> out;
    for (const auto& [name, scene] :
         {test::NamedScene{"soup", test::soup(250, 0.3f, 5)}, test::NamedScene{"torus", test::torus(10)},
          test::NamedScene{"instances", test::instances()}}) {
      Truth truth{name, scene, frames_of(scene.meshes[0].positions), {}};
      for (const Frame& frame : truth.frames) {
        Scene moved = scene;
        moved.meshes[0].positions = frame.positions;
        truth.expected.emplace_back(moved, test::troubling_rays(moved, 40, 3 + truth.expected.size()));
      }
      out.push_back(std::move(truth));
    }
    return out;
  }();
  return all;
}

/// Every layout over a tree that suits it; octrees and `spatial` cannot be refitted.
std::vector<std::string> recipes() {
  std::vector<std::string> out = {"fast",
                                  "default",
                                  "best",
                                  "sweep > wide(4)",
                                  "sweep > wide(16)",
                                  "sweep > wide(5)",
                                  "sweep > wide(8) > trace(order=axis)",
                                  "ploc > binary > trace(cull=off)"};
  for (const std::string& each : test::recipe_of_every_layout("binned")) out.push_back(each);
  return out;
}

class Moving : public testing::TestWithParam<std::string> {};

TEST_P(Moving, AnswersAreThoseOfBruteForceAfterEveryUpdate) {
  for (const Rebuild rebuild : {Rebuild::when_it_pays, Rebuild::never, Rebuild::worst_parts, Rebuild::all}) {
    for (const Truth& truth : truths()) {
      MovingStructure moving(truth.rest, GetParam(), {rebuild, 300, 50});
      for (std::size_t f = 0; f < truth.frames.size(); ++f) {
        moving.move_vertices(0, truth.frames[f].positions);
        moving.update();
        test::expect_brute_force_answers(moving.structure(), truth.expected[f],
                                         truth.name + ", " + truth.frames[f].name);
      }
    }
  }
}

TEST_P(Moving, OnlyTreesThatCutTriangles_AreRefused) {
  MovingStructure moving(test::torus(10), GetParam(), {Rebuild::never});
  const bool cuts = GetParam() == "best" || GetParam().starts_with("octree");
  EXPECT_EQ(moving.why_no_refit().empty(), !cuts) << moving.why_no_refit();
  const Positions twisted = truths()[1].frames[0].positions;
  moving.move_vertices(0, twisted);
  const UpdateReport report = moving.update();
  EXPECT_EQ(report.refitted, cuts ? 0u : 1u);
  EXPECT_EQ(report.rebuilt, cuts ? 1u : 0u);
  EXPECT_EQ(report.reason.empty(), !cuts);
}

std::string name_of(const testing::TestParamInfo<std::string>& parameters) {
  std::string name = std::to_string(parameters.index);
  for (const char c : parameters.param) name += std::isalnum(static_cast<unsigned char>(c)) ? std::string(1, c) : "";
  return name;
}

INSTANTIATE_TEST_SUITE_P(Registered, Moving, testing::ValuesIn(recipes()), name_of);

TEST(MovingStructureOf, AMeshWhoseTrianglesComeAndGo_IsRebuiltAndSaysWhy) {
  const Truth& torus = truths()[1];
  MovingStructure moving(torus.rest, "default", {Rebuild::never});
  moving.move_vertices(0, torus.frames[4].positions);
  UpdateReport report = moving.update();
  EXPECT_EQ(report.rebuilt, 1u);
  EXPECT_NE(report.reason.find("no area"), std::string::npos) << report.reason;
  EXPECT_EQ(moving.structure().report().primitives, 0u);
  moving.move_vertices(0, torus.frames[0].positions);
  report = moving.update();
  EXPECT_EQ(report.rebuilt, 1u);
  EXPECT_NE(report.reason.find("can be used now"), std::string::npos) << report.reason;
  EXPECT_EQ(moving.structure().report().primitives, torus.rest.unique_triangles());
}

TEST(MovingStructureOf, AStructureThatIsKept_StaysAsItWas) {
  const Truth& soup = truths()[0];
  for (const char* recipe : {"default", "sweep > binary"}) {
    MovingStructure moving(soup.rest, recipe, {Rebuild::never});
    moving.move_vertices(0, soup.frames[0].positions);
    moving.update();
    const Structure kept = moving.structure();
    moving.move_vertices(0, soup.frames[1].positions);
    moving.update();
    test::expect_brute_force_answers(kept, soup.expected[0], "kept");
    test::expect_brute_force_answers(moving.structure(), soup.expected[1], "moved on");
  }
}

/// What the structure's tree is like, as far as traversals see it.
std::vector<RayCounters> tests_of(const Structure& structure, const std::vector<Ray>& rays) {
  std::vector<Hit> hits(rays.size());
  std::vector<RayCounters> counters(rays.size());
  structure.closest_hits_counted(rays, hits, counters);
  return counters;
}

TEST(MovingStructureOf, AnyNumberOfThreads_IsTheSame) {
  const Scene scene = test::soup(6000, 0.05f, 9);
  const std::vector<Ray> rays = test::troubling_rays(scene, 300, 2);
  for (const Rebuild rebuild : {Rebuild::when_it_pays, Rebuild::never, Rebuild::worst_parts}) {
    MovingStructure one(scene, "default", {rebuild, 2e4, 50}, {.threads = 1});
    MovingStructure many(scene, "default", {rebuild, 2e4, 50}, {.threads = 5});
    Random random(3);
    Positions positions = scene.meshes[0].positions;
    for (int f = 0; f < 4; ++f) {
      for (Vec3& p : positions) p = p + test::random_point(random, 0.05f);
      one.move_vertices(0, positions);
      many.move_vertices(0, positions);
      const UpdateReport a = one.update(), b = many.update();
      EXPECT_EQ(a.rebuilt_triangles, b.rebuilt_triangles);
      EXPECT_EQ(one.quality().sah_cost, many.quality().sah_cost);
      EXPECT_EQ(one.quality().overlap, many.quality().overlap);
      EXPECT_EQ(tests_of(one.structure(), rays), tests_of(many.structure(), rays));
    }
  }
}

/// One corner of a soup goes wild, the rest stays.
Positions disturbed(const Scene& scene, float by) {
  Random random(4);
  Positions positions = scene.meshes[0].positions;
  for (Vec3& p : positions) {
    const Vec3 shift = test::random_point(random, by);
    if (p.x < -0.5f && p.y < 0 && p.z < 0) p = p + shift;
  }
  return positions;
}

TEST(MotionPolicyOf, RebuildsHappenOnceRefittingHasCostAsMuch) {
  const Scene scene = test::soup(4000, 0.05f, 1);
  const Positions moved = disturbed(scene, 0.3f);
  const auto rebuilt_after = [&](const MotionPolicy& policy) {
    MovingStructure moving(scene, "default", policy);
    for (int update = 1; update <= 40; ++update) {
      moving.move_vertices(0, moved);
      if (moving.update().rebuilt_triangles > 0) return update;
    }
    return 0;
  };
  EXPECT_EQ(rebuilt_after({Rebuild::when_it_pays, 0, 50}), 0);
  double rays = 1e9;
  EXPECT_EQ(rebuilt_after({Rebuild::when_it_pays, rays, 50}), 1);
  int updates = 1;
  for (; updates < 5; rays /= 2) updates = rebuilt_after({Rebuild::when_it_pays, rays / 2, 50});
  EXPECT_LE(updates, 10);
  EXPECT_NEAR(rebuilt_after({Rebuild::when_it_pays, rays / 2, 50}), 2 * updates, 1);
  EXPECT_EQ(rebuilt_after({Rebuild::when_it_pays, rays / 2, 25}), updates);
}

TEST(MotionPolicyOf, WhereLittleMoved_PartsAreRebuiltAndMakeUpForIt) {
  const Scene scene = test::soup(8000, 0.05f, 1);
  const auto quality_after = [&](Rebuild rebuild, UpdateReport& report) {
    MovingStructure moving(scene, "ploc(block=4) > reinsert > optimal-collapse(8) > wide(8)", {rebuild, 1e5, 50});
    for (int f = 0; f < 3; ++f) {
      moving.move_vertices(0, disturbed(scene, 0.3f));
      const UpdateReport update = moving.update();
      if (update.rebuilt_triangles > 0) report = update;
    }
    return moving.quality();
  };
  UpdateReport never, parts, paying, all;
  const double refitted = quality_after(Rebuild::never, never).sah_cost;
  const double in_parts = quality_after(Rebuild::worst_parts, parts).sah_cost;
  const double as_pays = quality_after(Rebuild::when_it_pays, paying).sah_cost;
  const double anew = quality_after(Rebuild::all, all).sah_cost;
  EXPECT_EQ(never.rebuilt_triangles, 0u);
  EXPECT_EQ(parts.rebuilt_in_part, 1u);
  EXPECT_GT(parts.rebuilt_triangles, 100u);
  EXPECT_LT(parts.rebuilt_triangles, 2000u);
  EXPECT_GT(paying.rebuilt_triangles, 0u);
  EXPECT_LT(in_parts, refitted);
  EXPECT_LT(as_pays, refitted);
  EXPECT_LT(anew, in_parts);
}

TEST(MovingStructureOf, InstancesAddedMovedAndRemoved_AnswerAsTheSceneSays) {
  for (const char* recipe : {"default", "sweep > binary", "best", "sweep > wide(4)"}) {
    MovingStructure moving(test::instances(), recipe);
    const auto check = [&](const std::vector<std::uint32_t>& removed, const char* what) {
      const UpdateReport report = moving.update();
      EXPECT_TRUE(report.placed_anew);
      Scene shown = moving.scene();
      shown.meshes.emplace_back();
      for (const std::uint32_t i : removed)
        shown.instances[i].mesh = static_cast<std::uint32_t>(shown.meshes.size() - 1);
      const test::Expected expected(shown, test::troubling_rays(shown, 120, 8));
      test::expect_brute_force_answers(moving.structure(), expected, std::string(recipe) + ": " + what);
    };
    moving.remove_instance(2);
    check({2}, "one removed");
    const std::uint32_t added = moving.add_instance({0, Transform::translate({0.3f, 0, 0.2f})});
    moving.move_instance(0, Transform::rotate({0, 0, 1}, 0.7f));
    check({2}, "one added, one moved");
    const std::uint32_t mesh = moving.add_mesh(test::torus(8).meshes[0]);
    moving.add_instance({mesh, Transform::translate({0, 0.5f, 0})});
    moving.remove_instance(added);
    check({2, added}, "a mesh added");
    Positions positions = moving.scene().meshes[mesh].positions;
    for (Vec3& p : positions) p.z *= 2;
    moving.move_vertices(mesh, positions);
    check({2, added}, "and moved");
  }
}

TEST(MovingStructureOf, ASingleMesh_MayBecomeManyAndNone) {
  const Scene scene = test::torus(8);
  MovingStructure moving(scene);
  const Ray ray{{1, 0, 5}, 0, {0, 0, -1}};
  EXPECT_EQ(moving.structure().closest_hit(ray).instance, 0u);
  const std::uint32_t added = moving.add_instance({0, Transform::translate({0, 0, 1})});
  moving.update();
  EXPECT_EQ(moving.structure().closest_hit(ray).instance, added);
  moving.remove_instance(added);
  moving.update();
  EXPECT_EQ(moving.structure().closest_hit(ray).instance, 0u);
  moving.remove_instance(0);
  moving.update();
  EXPECT_FALSE(moving.structure().any_hit(ray));
}

TEST(MovingStructureOf, WrongCalls_AreRefused) {
  MovingStructure moving(test::instances());
  EXPECT_THROW(moving.move_vertices(0, Positions(3)), UsageError);
  EXPECT_THROW(moving.move_vertices(99, {}), UsageError);
  EXPECT_THROW(moving.add_instance({77, {}}), UsageError);
  EXPECT_THROW(moving.move_instance(1000, {}), UsageError);
  moving.remove_instance(1);
  EXPECT_THROW(moving.remove_instance(1), UsageError);
  EXPECT_THROW(moving.add_mesh({"bad", {{}, {}}, {{0, 1, 2}}, {}, {}, {}}), Error);
  EXPECT_THROW(moving.set_policy({Rebuild::never, -1, 50}), UsageError);
  EXPECT_THROW(moving.set_policy({Rebuild::never, 1, 0}), UsageError);
  EXPECT_THROW(MovingStructure(test::instances(), "binned(cost=rdh) > wide(8)"), UsageError);
}

TEST(MovingStructureOf, AnUpdateThatFails_LeavesNoStructureUntilOneSucceeds) {
  MovingStructure moving(test::instances());
  const Transform before = moving.scene().instances[0].object_to_world;
  moving.move_instance(0, Transform::scale({0, 0, 0}));
  EXPECT_THROW(moving.update(), Error);
  EXPECT_THROW(moving.structure(), Error);
  moving.move_instance(0, before);
  moving.update();
  const test::Expected expected(test::instances(), test::troubling_rays(test::instances(), 50, 8));
  test::expect_brute_force_answers(moving.structure(), expected, "mended");
}

#ifdef BOXWOOD_EMBREE
TEST(MovingStructureOf, APeer_IsBuiltAnew) {
  const Scene scene = test::torus(8);
  MovingStructure moving(scene, "embree");
  EXPECT_FALSE(moving.why_no_refit().empty());
  EXPECT_THROW(moving.quality(), UsageError);
  Positions positions = scene.meshes[0].positions;
  for (Vec3& p : positions) p.z += 1;
  moving.move_vertices(0, positions);
  EXPECT_EQ(moving.update().rebuilt, 1u);
  EXPECT_NEAR(moving.structure().closest_hit({{1, 0, 5}, 0, {0, 0, -1}}).t, 3.6f, 0.05f);
}
#endif

}  // namespace
}  // namespace boxwood
