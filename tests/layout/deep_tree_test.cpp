// Trees as deep as they can be walk correctly; deeper ones are refused.
#include <gtest/gtest.h>

#include "boxwood/error.h"
#include "layout/encode.h"
#include "support/differential.h"
#include "support/layouts.h"
#include "support/rays.h"
#include "support/scenes.h"

namespace boxwood {
namespace {

std::shared_ptr<const Layout> encode_chain(const Scene& scene, const Stage& stage, const TraceOptions& trace) {
  Contents contents;
  contents.mesh = &scene.meshes[0];
  return stage.encode(stage.defaults, test::chain(scene.meshes[0]), contents, trace);
}

TEST(DeepTree, IsWalkedToItsEnd) {
  const Scene scene = test::soup(stack_entries, 0.1f, 4);
  const test::Expected expected(scene, test::troubling_rays(scene, 30, 1));
  for (const Stage& stage : {binary_stage(), wide_stage()}) {
    for (const TraversalMode mode : {TraversalMode::iterative, TraversalMode::recursive}) {
      const auto layout = encode_chain(scene, stage, {ChildOrder::near, true, mode});
      test::expect_brute_force_answers(*layout, expected, stage.name);
    }
  }
}

TEST(DeepTree, BeyondTheStackIsRefused) {
  const Scene scene = test::soup(stack_entries + 2, 0.1f, 4);
  for (const Stage& stage : {binary_stage(), wide_stage()}) EXPECT_THROW(encode_chain(scene, stage, {}), Error);
}

TEST(Encode, RefusesNodesWiderThanTheLayout) {
  const Scene scene = test::soup(20, 0.1f, 4);
  Contents contents;
  contents.mesh = &scene.meshes[0];
  const Tree tree = test::split_tree(test::triangle_boxes(scene.meshes[0]), {5, 1, false});
  EXPECT_THROW(binary_stage().encode(binary_stage().defaults, tree, contents, {}), UsageError);
  test::LayoutCall four(wide_stage());
  four.set("k", "4");
  EXPECT_THROW(four.stage.encode(four.options, tree, contents, {}), UsageError);
}

TEST(Encode, RefusesInstancesThatCannotBeInverted) {
  Scene scene = test::instances();
  scene.instances[4].object_to_world = Transform::scale({1, 0, 1});
  EXPECT_THROW(test::encode_scene(scene, test::LayoutCall(binary_stage()), {}), Error);
}

TEST(Encode, CountsItsBytesExactly) {
  const Scene scene = test::soup(100, 0.1f, 4);
  const Tree two = test::split_tree(test::triangle_boxes(scene.meshes[0]), {2, 1, false});
  Contents contents;
  contents.mesh = &scene.meshes[0];
  EXPECT_EQ(two.nodes.size(), 199u);
  EXPECT_EQ(binary_stage().encode(binary_stage().defaults, two, contents, {})->bytes(), 199u * 32 + 100u * 40);
  test::LayoutCall wide(wide_stage());
  wide.set("k", "2");
  EXPECT_EQ(wide.stage.encode(wide.options, two, contents, {})->bytes(), 99u * 64 + 100u * 40);
}

}  // namespace
}  // namespace boxwood
