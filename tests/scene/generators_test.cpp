#include "scene/generators.h"

#include <gtest/gtest.h>

#include <cstring>
#include <set>

#include "scene/placement.h"
#include "support/closed_mesh.h"

namespace boxwood {
namespace {

class EveryGenerator : public ::testing::TestWithParam<std::string> {};

std::vector<std::string> generator_names() {
  std::vector<std::string> names;
  for (const Generator& generator : generators()) names.push_back(generator.name);
  return names;
}

INSTANTIATE_TEST_SUITE_P(Generators, EveryGenerator, ::testing::ValuesIn(generator_names()), [](const auto& param) {
  std::string name = param.param;
  std::replace(name.begin(), name.end(), '-', '_');
  return name;
});

/// Byte by byte, so that NaN equals itself.
template <class T>
bool same_bytes(const std::vector<T>& a, const std::vector<T>& b) {
  return a.size() == b.size() && (a.empty() || std::memcmp(a.data(), b.data(), a.size() * sizeof(T)) == 0);
}

TEST_P(EveryGenerator, IsDeterministicAndValid) {
  const Scene a = generate(GetParam()), b = generate(GetParam());
  EXPECT_EQ(find_bad_index(a), "");
  EXPECT_EQ(a.name, GetParam());
  ASSERT_EQ(a.meshes.size(), b.meshes.size());
  for (std::size_t i = 0; i < a.meshes.size(); ++i) {
    EXPECT_TRUE(same_bytes(a.meshes[i].positions, b.meshes[i].positions));
    EXPECT_EQ(a.meshes[i].triangles, b.meshes[i].triangles);
  }
  ASSERT_EQ(a.instances.size(), b.instances.size());
  for (std::size_t i = 0; i < a.instances.size(); ++i) {
    EXPECT_EQ(a.instances[i].object_to_world, b.instances[i].object_to_world);
  }
}

TEST_P(EveryGenerator, LoadsWithACamera) {
  const Scene scene = load("generate:" + GetParam());
  ASSERT_FALSE(scene.cameras.empty());
  EXPECT_EQ(scene.cameras.back().name, "auto");
}

TEST_P(EveryGenerator, PrintsItsOptions) {
  const auto found = std::find_if(generators().begin(), generators().end(),
                                  [](const Generator& generator) { return generator.name == GetParam(); });
  EXPECT_FALSE(found->summary.empty());
  for (const Option& option : found->options) {
    EXPECT_FALSE(option.help.empty());
    std::any options = found->defaults;
    option.set(options, option.get(options));
    EXPECT_EQ(option.get(options), option.get(found->defaults));
  }
}

TEST_P(EveryGenerator, ASeedChangesTheScene) {
  for (const Generator& generator : generators()) {
    if (generator.name != GetParam()) continue;
    for (const Option& option : generator.options) {
      if (option.name != "seed") continue;
      const Scene a = generate(GetParam() + "(seed=1)"), b = generate(GetParam() + "(seed=2)");
      const bool same_places =
          a.instances.size() < 2 || a.instances[1].object_to_world == b.instances[1].object_to_world;
      EXPECT_FALSE(same_bytes(a.meshes[0].positions, b.meshes[0].positions) && same_places);
    }
  }
}

std::uint64_t triangles(std::string_view call) { return generate(call).placed_triangles(); }

TEST(Generators, MakeAsManyTrianglesAsAsked) {
  EXPECT_EQ(triangles("random(17)"), 17u);
  EXPECT_EQ(triangles("random(0)"), 0u);
  EXPECT_EQ(triangles("displaced(x=3, y=2, z=2)"), 12u);
  EXPECT_EQ(triangles("tetrahedra(x=3, y=1, z=1)"), 12u);
  EXPECT_EQ(triangles("sphere(detail=5)"), 300u);
  EXPECT_EQ(triangles("cube"), 12u);
  EXPECT_EQ(triangles("torus(5)"), 100u);
  EXPECT_EQ(triangles("knot(4)"), 256u);
  EXPECT_EQ(triangles("sphereflake(depth=2, detail=1)"), 91u * 12);
  EXPECT_EQ(triangles("hair(strands=3, pieces=4)"), 24u);
  EXPECT_EQ(triangles("terrain(size=10)"), 200u);
  EXPECT_EQ(triangles("lawn(blades=10)"), 72u);
  EXPECT_EQ(triangles("instances(count=9, detail=3)"), 9u * 144);
  EXPECT_EQ(triangles("single"), 1u);
  EXPECT_EQ(triangles("none"), 0u);
}

TEST(Generators, ClosedOnesAreClosedAndFaceOutwards) {
  for (const std::string_view call : {"cube", "cube(3)", "sphere(1)", "sphere(7)", "torus(3)", "torus(9)", "knot(3)",
                                      "knot(8)", "sphereflake(depth=1, detail=2)", "tetrahedra(x=2, y=2, z=2)"}) {
    const Mesh mesh = generate(call).meshes[0];
    EXPECT_TRUE(is_closed(mesh)) << call;
    EXPECT_GT(signed_volume(mesh), 0) << call;
  }
  EXPECT_NEAR(signed_volume(generate("cube(5)").meshes[0]), 8, 1e-4);
  EXPECT_NEAR(signed_volume(generate("sphere(60)").meshes[0]), 4.18879, 5e-3);
}

TEST(Generators, RandomSetsAreNested) {
  const Mesh few = generate("random(5, size=1)").meshes[0], many = generate("random(9, size=1)").meshes[0];
  EXPECT_TRUE(std::equal(few.positions.begin(), few.positions.end(), many.positions.begin()));
}

TEST(Generators, SolidsHaveEqualEdges) {
  for (const std::string_view call : {"displaced(x=4, y=4, z=4, edge=0.5)", "tetrahedra(x=4, y=4, z=4, edge=0.5)"}) {
    const Mesh mesh = generate(call).meshes[0];
    for (const Triangle& t : mesh.triangles) {
      for (std::size_t i = 0; i < 3; ++i) {
        EXPECT_NEAR(length(mesh.positions[t[i]] - mesh.positions[t[(i + 1) % 3]]), 0.5f, 1e-5f);
      }
    }
  }
}

TEST(Generators, DegenerateOnesAreWhatTheySay) {
  const auto notes = [](const char* call) { return load(std::string("generate:") + call).notes; };
  EXPECT_EQ(notes("zero-area(99)").degenerate_triangles, 99u);
  EXPECT_EQ(notes("non-finite(40)").non_finite_triangles, 30u);
  EXPECT_EQ(notes("huge(50)").non_finite_triangles, 0u);
  const Mesh coplanar = generate("coplanar").meshes[0];
  for (const Vec3& p : coplanar.positions) EXPECT_EQ(p.z, 0);
  const Mesh nested = generate("nested(20)").meshes[0];
  for (const auto& [a, b, c] : nested.triangles) {
    Box box;
    for (const std::uint32_t i : {a, b, c}) box.grow(nested.positions[i]);
    EXPECT_EQ(box.lower + box.upper, (Vec3{0, 0, 0}));
  }
}

TEST(Generators, WrongCallsAreExplained) {
  const auto told = [](std::string_view call) -> std::string {
    try {
      generate(call);
    } catch (const UsageError& error) {
      return error.what();
    }
    return {};
  };
  EXPECT_NE(told("terain").find("did you mean 'terrain'?"), std::string::npos);
  EXPECT_NE(told("random(trangles=5)").find("did you mean 'triangles'?"), std::string::npos);
  EXPECT_NE(told("random(triangles=many)").find("option 'triangles' of 'random' takes"), std::string::npos);
  EXPECT_NE(told("random(5").find("parentheses"), std::string::npos);
  EXPECT_NE(told("random)").find("parentheses"), std::string::npos);
  EXPECT_NE(told("random(5)x").find("parentheses"), std::string::npos);
  EXPECT_NE(told("none(1)").find("'none' needs its options by name"), std::string::npos);
  EXPECT_NE(told("sphereflake(7, detail=256)").find("more than 200000000"), std::string::npos);
  EXPECT_NE(told("").find("no generator is called ''"), std::string::npos);
}

}  // namespace
}  // namespace boxwood
