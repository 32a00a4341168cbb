#include "scene/cameras.h"

#include <cmath>
#include <numbers>

#include "temporary_folder.h"

namespace boxwood {
namespace {

/// Whether a square image of the camera shows all of the sphere around the box.
bool shows(const Camera& camera, const Box& box) {
  const Vec3 to_center = box.center() - camera.eye;
  const double radius = static_cast<double>(length(box.extent())) / 2,
               distance = static_cast<double>(length(to_center));
  const double half_angle = static_cast<double>(camera.fov) * std::numbers::pi / 360;
  const double cosine = static_cast<double>(dot(to_center, normalize(camera.direction))) / distance;
  const double off_axis = std::acos(std::min(cosine, 1.0));
  return distance > radius && off_axis + std::asin(radius / distance) <= half_angle;
}

const Box boxes[] = {{{-1, -1, -1}, {1, 1, 1}},
                     {{0, 0, 0}, {100, 1, 3}},
                     {{1000, 1000, 1000}, {1001, 1002, 1000}},
                     {{-1e-6f, 0, 0}, {1e-6f, 1e-6f, 0}},
                     {{-1e11f, -1e11f, -1e11f}, {1e11f, 1e11f, 1e11f}}};

TEST(Framing, ShowsTheBoundingSphere) {
  for (const Box& box : boxes) EXPECT_TRUE(shows(frame(box), box));
}

TEST(Framing, OfNothingOrAPointIsStillACamera) {
  for (const Box& box : {Box{}, Box{{0, 0, 0}, {0, 0, 0}}, Box{{5, 5, 5}, {5, 5, 5}}}) {
    const Camera camera = frame(box);
    EXPECT_TRUE(is_finite(camera.eye));
    EXPECT_NEAR(length(camera.direction), 1, 1e-5);
    EXPECT_NE(camera.eye, box.lower);
  }
}

TEST(OrbitPath, ShowsTheBoundingSphereFromEveryFrame) {
  for (const Box& box : boxes) {
    const std::vector<Camera> path = orbit_path(box, 7);
    ASSERT_EQ(path.size(), 7u);
    for (const Camera& camera : path) EXPECT_TRUE(shows(camera, box));
  }
}

TEST(OrbitPath, RunsEvenlyAroundTheCenter) {
  const std::vector<Camera> path = orbit_path(Vec3{1, 2, 3}, 10, 4, 4);
  EXPECT_EQ(path[0].eye, (Vec3{1, 6, 13}));
  EXPECT_EQ(path[1].eye, (Vec3{11, 6, 3}));
  EXPECT_EQ(path[2].eye, (Vec3{1, 6, -7}));
  EXPECT_EQ(path[3].name, "orbit-003");
  EXPECT_THROW(orbit_path(Vec3{}, 0, 0, 4), UsageError);
  EXPECT_THROW(orbit_path(Vec3{}, 1, 0, 0), UsageError);
}

TEST(SplinePath, PassesThroughItsKeyFrames) {
  const Camera keys[] = {{"a", {0, 0, 0}, {0, 0, -2}, {0, 1, 0}, 40},
                         {"b", {1, 5, 0}, {1, 0, 0}, {0, 1, 0}, 60},
                         {"c", {4, 0, 1}, {0, 0, 1}, {0, 1, 0}, 50}};
  const std::vector<Camera> path = spline_path(keys, 9);
  ASSERT_EQ(path.size(), 9u);
  for (std::size_t k = 0; k < 3; ++k) {
    EXPECT_NEAR(length(path[4 * k].eye - keys[k].eye), 0, 1e-5);
    EXPECT_NEAR(length(path[4 * k].direction - normalize(keys[k].direction)), 0, 1e-5);
    EXPECT_NEAR(path[4 * k].fov, keys[k].fov, 1e-4);
  }
  for (const Camera& camera : path) EXPECT_NEAR(length(camera.direction), 1, 1e-5);
}

TEST(SplinePath, OneKeyFrameStandsStill) {
  const Camera key{"a", {1, 2, 3}, {0, 0, -1}, {0, 1, 0}, 40};
  for (const Camera& camera : spline_path({&key, 1}, 5)) EXPECT_EQ(camera.eye, key.eye);
  EXPECT_EQ(spline_path({&key, 1}, 1).size(), 1u);
  EXPECT_THROW(spline_path({}, 5), UsageError);
  EXPECT_THROW(spline_path({&key, 1}, 0), UsageError);
}

using CameraFile = TemporaryFolder;

TEST_F(CameraFile, ReadsBackExactlyWhatWasWritten) {
  const std::vector<Camera> cameras = {{"a \"quoted\" näme", {0.1f, -1e-7f, 3e11f}, {1.0f / 3, 0, 1}, {0, 1, 0}, 77.3f},
                                       {"b", {0, 0, 0}, {0, 0, -1}, {1, 0, 0}, 60, true, 320, 200}};
  write_cameras(path("c.cameras.json"), cameras);
  const std::vector<Camera> back = read_cameras(path("c.cameras.json"));
  ASSERT_EQ(back.size(), 2u);
  for (std::size_t i = 0; i < 2; ++i) {
    EXPECT_EQ(back[i].name, cameras[i].name);
    EXPECT_EQ(back[i].eye, cameras[i].eye);
    EXPECT_EQ(back[i].direction, cameras[i].direction);
    EXPECT_EQ(back[i].up, cameras[i].up);
    EXPECT_EQ(back[i].fov, cameras[i].fov);
    EXPECT_EQ(back[i].mirrored, cameras[i].mirrored);
    EXPECT_EQ(back[i].width, cameras[i].width);
    EXPECT_EQ(back[i].height, cameras[i].height);
  }
}

TEST_F(CameraFile, WrongFieldsAreNamed) {
  const auto with = [](const std::string& fields) { return "{\"cameras\": [{" + fields + "}]}"; };
  const std::string rest = R"("eye": [0, 0, 0], "direction": [0, 0, 1], "up": [0, 1, 0])";
  const std::pair<std::string, std::string> cases[] = {
      {"{\"cameras\": [", "is not valid JSON"},
      {"[]", "must be an object with one field 'cameras'"},
      {"{\"cameras\": 1}", "must be an object with one field 'cameras'"},
      {"{\"cameras\": [1]}", "camera 1 must be an object"},
      {with("\"name\": \"a\", \"fov\": 60"), "camera 1 lacks the field 'eye'"},
      {with("\"name\": 5, \"fov\": 60, " + rest), "camera 1 field 'name' must be a text"},
      {with("\"name\": \"a\", " + rest), "camera 1 lacks the field 'fov'"},
      {with("\"name\": \"a\", \"fov\": 180, " + rest), "camera 1 field 'fov' must be an angle"},
      {with("\"name\": \"a\", \"fov\": \"x\", " + rest), "camera 1 field 'fov' must hold numbers"},
      {with("\"name\": \"a\", \"fov\": 60, \"mirrored\": 1, " + rest), "field 'mirrored' must be true or false"},
      {with("\"name\": \"a\", \"fov\": 60, \"size\": [0, 9], " + rest), "field 'size' must be an array of width"},
      {with("\"name\": \"a\", \"fov\": 60, \"eyes\": 1, " + rest), "unknown field 'eyes'; did you mean 'eye'?"},
      {with(R"("name": "a", "fov": 60, "eye": [0, 0], "direction": [0, 0, 1], "up": [0, 1, 0])"),
       "camera 1 field 'eye' must be an array of three numbers"},
      {with(R"("name": "a", "fov": 60, "eye": [0, 0, 0], "direction": [0, 0, 0], "up": [0, 1, 0])"),
       "fields 'direction' and 'up' must not be zero"},
      {with(R"("name": "a", "fov": 60, "eye": [0, 0, 1e300], "direction": [0, 0, 1], "up": [0, 1, 0])"),
       "field 'eye' must hold numbers"},
      {"{\"cameras\": [{\"name\": \"a\", \"fov\": 60, " + rest + "}, {\"name\": \"a\", \"fov\": 60, " + rest + "}]}",
       "two cameras are called 'a'"},
  };
  for (const auto& [text, expected] : cases) {
    std::string told;
    try {
      read_cameras(write("c.cameras.json", text));
    } catch (const Error& error) {
      told = error.what();
    }
    EXPECT_NE(told.find(expected), std::string::npos) << "'" << told << "' for " << text;
    EXPECT_TRUE(is_one_sentence(told, path("c.cameras.json")));
  }
}

TEST_F(CameraFile, WhatCannotBeWrittenIsExplained) {
  const Camera bad{"bad", {std::numeric_limits<float>::quiet_NaN(), 0, 0}, {0, 0, 1}, {0, 1, 0}, 60};
  EXPECT_THROW(write_cameras(path("c.json"), {&bad, 1}), Error);
  EXPECT_THROW(write_cameras(path("no/such/folder.json"), {}), Error);
}

}  // namespace
}  // namespace boxwood
