// trace(precision=double): meshes and rays in single precision, triangles tested in double.
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "boxwood/structure.h"
#include "recipe/capabilities.h"
#include "support/differential.h"
#include "support/rays.h"
#include "support/scenes.h"
#include "trace/precise_brute_force.h"
#include "trace/widened.h"

namespace boxwood {
namespace {

test::Expected in_double(const Scene& scene, const std::vector<Ray>& rays) {
  std::vector<DoubleVec3> vertices;
  for (const Vec3& v : scene.meshes[0].positions) vertices.push_back(widened(v));
  const PreciseBruteForce truth(vertices, scene.meshes[0].triangles);
  test::Expected expected(scene, rays);
  for (std::size_t i = 0; i < rays.size(); ++i) expected.hits[i] = rounded(truth.closest_hit(widened(rays[i])));
  return expected;
}

/// Spatial splits as well: a triangle may be in several leaves.
TEST(PrecisionOption, AnyRecipeItSuits_AnswersLikeTestingEveryTriangleInDouble) {
  for (const char* recipe :
       {"binned > wide(8)", "best", "median > wide(4)", "ploc > compressed(8)", "sweep > wide(16)"}) {
    const std::string text = Recipe::parse(recipe).text() + " > trace(precision=double)";
    for (const Scene& scene : {test::torus(12), test::soup(300, 0.2f, 4), test::soup(300, 0.2f, 5, 1e6f, {1e7f, 0, 0}),
                               test::scene_of({}, {})}) {
      const auto rays = test::troubling_rays(scene, 600, 3);
      test::expect_brute_force_answers(build(scene, text), in_double(scene, rays), text);
    }
  }
}

TEST(PrecisionOption, DiffersFromSingle) {
  const Scene scene = test::soup(300, 0.2f, 5, 1e6f, {1e7f, 0, 0});
  const auto rays = test::troubling_rays(scene, 600, 3);
  const test::Expected expected(scene, rays);
  std::vector<Hit> hits(rays.size());
  build(scene, "binned > wide(8) > trace(precision=double)").closest_hits(rays, hits);
  EXPECT_NE(hits, expected.hits);
}

TEST(PrecisionOption, IsRefusedWhereItDoesNotApply) {
  for (const char* recipe : {"binned > binary", "binned > slab", "octree > bit-octree"}) {
    EXPECT_THROW(Recipe::parse(std::string(recipe) + " > trace(precision=double)"), UsageError) << recipe;
  }
  EXPECT_THROW(Recipe::parse("binned > wide(8) > trace(order=axis, precision=double)"), UsageError);
  const char* recipe = "binned > wide(8) > trace(precision=double)";
  Scene two = test::cube(1);
  two.instances.push_back(two.instances[0]);
  EXPECT_THROW(build(two, recipe), UsageError);
  const Structure structure = build(test::cube(1), recipe);
  EXPECT_THROW(structure.all_hits({{0, 0, 3}, 0, {0, 0, -1}}), UsageError);
  const std::vector<Structure> parts = {structure};
  const std::vector<Instance> instances = {{0, {}}};
  EXPECT_THROW(place(parts, instances), UsageError);
}

TEST(PrecisionOption, SingleIsNotWrittenOut) {
  EXPECT_EQ(Recipe::parse("binned > wide(8) > trace(precision=single)"), Recipe::parse("binned > wide(8)"));
  const Recipe recipe = Recipe::parse("binned > wide(8) > trace(precision=double)");
  EXPECT_EQ(Recipe::parse(recipe.text()), recipe);
  EXPECT_FALSE(answers_exactly(recipe.stages()));
}

}  // namespace
}  // namespace boxwood
