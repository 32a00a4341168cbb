// Mouse and keys do to the camera what they say.
#include "logic/camera_control.h"

#include <gtest/gtest.h>

#include <cmath>

#include "logic/key_bindings.h"

namespace boxwood::viewer {
namespace {

const Box unit_box{{-1, -1, -1}, {1, 1, 1}};

Camera in_front() {
  Camera camera;
  camera.eye = {0, 0, 5};
  camera.direction = {0, 0, -1};
  camera.up = {0, 1, 0};
  return camera;
}

void expect_near(const Vec3& a, const Vec3& b, float tolerance = 1e-5f) {
  EXPECT_LE(length(a - b), tolerance) << a.x << ' ' << a.y << ' ' << a.z;
}

TEST(CameraControl, TrackballTurnsAboutTheSceneAndKeepsLookingAtIt) {
  CameraControl control(in_front(), unit_box);
  control.turn(0.5f, 0);  // half a window height: a quarter turn
  expect_near(control.camera().eye, {-5, 0, 0});
  expect_near(control.camera().direction, {1, 0, 0});
  control.turn(0.1f, 0.2f);
  EXPECT_NEAR(length(control.camera().eye), 5, 1e-4f);
  expect_near(control.camera().direction, normalize(-control.camera().eye), 1e-4f);
}

TEST(CameraControl, FirstPersonTurnsWhereItStands) {
  CameraControl control(in_front(), unit_box);
  control.scheme = CameraScheme::first_person;
  control.turn(0.5f, 0);
  EXPECT_EQ(control.camera().eye, in_front().eye);
  expect_near(control.camera().direction, {1, 0, 0});
}

TEST(CameraControl, NeverTurnsOverThePoles) {
  CameraControl control(in_front(), unit_box);
  for (int i = 0; i < 20; ++i) control.turn(0, 0.3f);
  EXPECT_LT(control.camera().direction.y, -0.99f);
  EXPECT_LT(std::fabs(dot(control.camera().direction, control.camera().up)), 1.0f);
  for (int i = 0; i < 40; ++i) control.turn(0, -0.3f);
  EXPECT_GT(control.camera().direction.y, 0.99f);
  EXPECT_TRUE(is_finite(control.camera().eye));
}

TEST(CameraControl, ZoomComesNearerAndNeverPasses) {
  CameraControl control(in_front(), unit_box);
  control.zoom(1);
  EXPECT_LT(control.camera().eye.z, 5);
  control.zoom(200);
  EXPECT_GE(control.camera().eye.z, 0);
  expect_near(control.camera().direction, {0, 0, -1});
}

TEST(CameraControl, KeysMoveAlongTheViewAndOppositesCancel) {
  CameraControl control(in_front(), unit_box);
  control.scheme = CameraScheme::first_person;
  MoveKeys keys;
  keys.forward = keys.back = true;
  control.move(keys, 1);
  EXPECT_EQ(control.camera().eye, in_front().eye);
  keys = {};
  keys.forward = true;
  control.move(keys, 0.5f);
  const float step = 0.25f * length(unit_box.extent());
  expect_near(control.camera().eye, {0, 0, 5 - step});
  keys = {};
  keys.right = true;
  control.move(keys, 0.5f);
  expect_near(control.camera().eye, {step, 0, 5 - step});
}

TEST(CameraControl, PanMovesThePictureWithTheMouse) {
  CameraControl control(in_front(), unit_box);
  control.pan(0.1f, 0);
  EXPECT_LT(control.camera().eye.x, 0);
  EXPECT_EQ(control.camera().direction, in_front().direction);
}

TEST(CameraControl, WorksWithoutABoxAndWithUpAlongTheView) {
  Camera camera = in_front();
  camera.up = camera.direction;
  CameraControl control(camera, Box{});
  control.turn(0.1f, 0.1f);
  control.pan(0.1f, 0.1f);
  control.zoom(1);
  EXPECT_TRUE(is_finite(control.camera().eye));
  EXPECT_TRUE(is_finite(control.camera().direction));
}

TEST(KeyBindings, EachKeyDoesOneThingInEitherCase) {
  for (const KeyBinding& binding : key_bindings()) {
    EXPECT_EQ(action_of(binding.key), binding.action);
    EXPECT_FALSE(binding.help.empty());
    for (const KeyBinding& other : key_bindings()) {
      EXPECT_TRUE(&other == &binding || other.key != binding.key);
    }
  }
  EXPECT_EQ(action_of('W'), Action::forward);
  EXPECT_EQ(action_of('O'), Action::save_camera);
  EXPECT_EQ(action_of('$'), std::nullopt);
}

}  // namespace
}  // namespace boxwood::viewer
