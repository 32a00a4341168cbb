// The painter ends with the picture that render() makes, whatever was asked in between.
#include "logic/painter.h"

#include <gtest/gtest.h>

#include "render/render.h"
#include "support/scenes.h"

namespace boxwood::viewer {
namespace {

std::vector<Scene> two_frames() {
  std::vector<Scene> frames{test::sphere(12), test::torus(12)};
  for (Scene& frame : frames) frame.cameras = {Camera{"front", {0, 0, 4}, {0, 0, -1}, {0, 1, 0}, 50}};
  return frames;
}

ViewState state_of(const Scene& scene) {
  ViewState state;
  state.settings.camera = scene.cameras[0];
  state.settings.width = 48;
  state.settings.height = 32;
  return state;
}

Image rendered(const Scene& scene, const ViewState& state) {
  RenderSettings settings = state.settings;
  settings.spp = 1;
  settings.seed = 1;
  return render(scene, build(scene, state.recipes[0]), settings).image;
}

TEST(Painter, EndsWithThePictureThatRenderMakes) {
  const std::vector<Scene> frames = two_frames();
  Painter painter(frames, 1, 1);
  const ViewState state = state_of(frames[0]);
  painter.show(state);
  painter.wait_for_full_picture();
  const auto picture = painter.pictures()[0];
  ASSERT_TRUE(picture);
  EXPECT_EQ(picture->divisor, 1u);
  EXPECT_EQ(picture->image, rendered(frames[0], state));
  EXPECT_GT(painter.built(0)->tree->nodes.size(), 1u);
}

TEST(Painter, FollowsTheNewestStateOfMany) {
  const std::vector<Scene> frames = two_frames();
  Painter painter(frames, 2, 1);
  ViewState state = state_of(frames[0]);
  for (int i = 0; i < 30; ++i) {
    state.settings.camera.eye.x = 0.05f * static_cast<float>(i);
    painter.show(state);
  }
  state.frame = 1;
  state.recipes[0] = "sweep > slab";
  painter.show(state);
  painter.wait_for_full_picture();
  EXPECT_EQ(painter.pictures()[0]->image, rendered(frames[1], state));
  EXPECT_EQ(painter.pictures()[0]->recipe, "sweep > slab");
}

TEST(Painter, ComparesTwoRecipesToTheBit) {
  const std::vector<Scene> frames = two_frames();
  Painter painter(frames, 2, 1);
  ViewState state = state_of(frames[0]);
  state.recipes = {"sweep > slab", "binned > wide(8)"};
  state.compare = true;
  painter.show(state);
  painter.wait_for_full_picture();
  ASSERT_TRUE(painter.pictures()[1]);
  EXPECT_EQ(painter.pictures()[0]->image, painter.pictures()[1]->image);
  EXPECT_NE(painter.pictures()[0]->recipe, painter.pictures()[1]->recipe);
}

TEST(Painter, SaysWhatIsWrongWithARecipeAndGoesOn) {
  const std::vector<Scene> frames = two_frames();
  Painter painter(frames, 1, 1);
  ViewState state = state_of(frames[0]);
  state.recipes[0] = "sweeep > binary";
  painter.show(state);
  painter.wait_for_full_picture();
  EXPECT_NE(painter.trouble().find("sweep"), std::string::npos);
  state.recipes[0] = "sweep > binary";
  painter.show(state);
  painter.wait_for_full_picture();
  EXPECT_EQ(painter.trouble(), "");
  EXPECT_EQ(painter.pictures()[0]->image, rendered(frames[0], state));
}

TEST(ViewState, AnOrderTakesThePlaceOfTheRecipesOwn) {
  EXPECT_EQ(with_order("sweep > binary", ""), "sweep > binary");
  EXPECT_EQ(with_order("sweep > binary", "axis"), "sweep > binary > trace(order=axis)");
  EXPECT_EQ(with_order("sweep > binary > trace(order=none, mode=recursive)", "axis"),
            "sweep > binary > trace(order=axis, mode=recursive)");
  EXPECT_THROW(with_order("swep > binary", "axis"), UsageError);
}

}  // namespace
}  // namespace boxwood::viewer
