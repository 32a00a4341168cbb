#include "render/camera_rays.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>

#include "boxwood/error.h"

namespace boxwood {
namespace {

Camera forward_camera(float fov = 60) { return {"test", {1, 2, 3}, {0, 0, -5}, {0, 1, 0}, fov}; }

void expect_near(const Vec3& a, const Vec3& b, float tolerance = 1e-6f) {
  EXPECT_NEAR(a.x, b.x, tolerance);
  EXPECT_NEAR(a.y, b.y, tolerance);
  EXPECT_NEAR(a.z, b.z, tolerance);
}

/// Image plane position of a ray in pixels.
std::pair<float, float> pixel_position(const Ray& ray, float fov, float width, float height) {
  const float half = std::tan(fov * std::numbers::pi_v<float> / 360) / std::min(width, height);
  const float x = ray.direction.x / -ray.direction.z, y = ray.direction.y / -ray.direction.z;
  return {(x / (half * width) + 1) / 2 * width, (1 - y / (half * height)) / 2 * height};
}

TEST(CameraRays, MiddlePixelLooksAlongTheDirection) {
  const Ray ray = CameraRays(forward_camera(), 101, 51, 1, 1).ray(50, 25, 0);
  EXPECT_EQ(ray.origin, (Vec3{1, 2, 3}));
  expect_near(ray.direction, {0, 0, -1});
  EXPECT_EQ(ray.t_near, 0);
  EXPECT_TRUE(std::isinf(ray.t_far));
}

TEST(CameraRays, FirstPixelIsTopLeft) {
  const CameraRays camera(forward_camera(), 64, 32, 1, 1);
  EXPECT_LT(camera.ray(0, 0, 0).direction.x, 0);
  EXPECT_GT(camera.ray(0, 0, 0).direction.y, 0);
  EXPECT_EQ(camera.ray(64 * 31 + 63, 0).direction, camera.ray(63, 31, 0).direction);
  EXPECT_GT(camera.ray(63, 31, 0).direction.x, 0);
  EXPECT_LT(camera.ray(63, 31, 0).direction.y, 0);
}

TEST(CameraRays, AMirroredCameraSwapsLeftAndRight) {
  Camera mirrored = forward_camera();
  mirrored.mirrored = true;
  const Ray right = CameraRays(forward_camera(), 64, 32, 1, 1).ray(63, 5, 0);
  expect_near(CameraRays(mirrored, 64, 32, 1, 1).ray(0, 5, 0).direction, right.direction);
}

TEST(CameraRays, FieldOfViewSpansTheShorterSide) {
  for (const auto& [width, height] : {std::pair{200u, 100u}, {100u, 200u}, {100u, 100u}}) {
    const CameraRays camera(forward_camera(90), width, height, 1, 1);
    for (const std::uint32_t x : {0u, width - 1}) {
      for (const std::uint32_t y : {0u, height - 1}) {
        const auto [px, py] =
            pixel_position(camera.ray(x, y, 0), 90, static_cast<float>(width), static_cast<float>(height));
        EXPECT_NEAR(px, static_cast<float>(x) + 0.5f, 1e-3f);
        EXPECT_NEAR(py, static_cast<float>(y) + 0.5f, 1e-3f);
      }
    }
  }
}

TEST(CameraRays, SamplesStayInTheirPixelAndSpreadEvenly) {
  constexpr std::uint32_t samples = 64;
  const CameraRays camera(forward_camera(), 8, 8, samples, 1);
  for (const std::uint32_t x : {0u, 5u}) {
    std::vector<int> quadrants(4, 0);
    for (std::uint32_t sample = 0; sample < samples; ++sample) {
      auto [px, py] = pixel_position(camera.ray(x, 3, sample), 60, 8, 8);
      px -= static_cast<float>(x);
      py -= 3;
      ASSERT_GE(px, -1e-4f);
      ASSERT_LE(px, 1 + 1e-4f);
      ASSERT_GE(py, -1e-4f);
      ASSERT_LE(py, 1 + 1e-4f);
      ++quadrants[(px > 0.5f ? 1 : 0) + (py > 0.5f ? 2 : 0)];
    }
    for (const int count : quadrants) EXPECT_NEAR(count, samples / 4, 3);
  }
}

TEST(CameraRays, SamplesDependOnSeedAndPixel) {
  const CameraRays a(forward_camera(), 8, 8, 4, 1), b(forward_camera(), 8, 8, 4, 2);
  EXPECT_EQ(a.ray(3, 3, 1).direction, CameraRays(forward_camera(), 8, 8, 4, 1).ray(3, 3, 1).direction);
  EXPECT_NE(a.ray(3, 3, 1).direction, b.ray(3, 3, 1).direction);
  EXPECT_NE(pixel_position(a.ray(3, 3, 0), 60, 8, 8).first - 3, pixel_position(a.ray(4, 3, 0), 60, 8, 8).first - 4);
}

TEST(CameraRays, BadUpFallsBackToAnImageThatIsNotFlat) {
  const float nan = std::numeric_limits<float>::quiet_NaN();
  for (const Vec3 up : {Vec3{0, 0, 1}, Vec3{0, 0, -2}, Vec3{0, 0, 0}, Vec3{nan, 0, 0}}) {
    Camera camera = forward_camera();
    camera.up = up;
    const CameraRays rays(camera, 9, 9, 1, 1);
    expect_near(rays.ray(4, 4, 0).direction, {0, 0, -1});
    const Vec3 across = rays.ray(8, 4, 0).direction - rays.ray(0, 4, 0).direction;
    const Vec3 down = rays.ray(4, 8, 0).direction - rays.ray(4, 0, 0).direction;
    EXPECT_NEAR(length(across), length(down), 1e-5f);
    EXPECT_GT(length(across), 0.5f);
    EXPECT_NEAR(dot(across, down), 0, 1e-5f);
  }
}

TEST(CameraRays, ExtremeLengthsOfDirectionAndUpChangeNothing) {
  Camera camera = forward_camera();
  const Ray expected = CameraRays(camera, 9, 9, 1, 1).ray(2, 3, 0);
  for (const float size : {1e-30f, 1e30f}) {
    camera.direction = Vec3{0, 0, -1} * size;
    camera.up = Vec3{0, 1, 0} * size;
    expect_near(CameraRays(camera, 9, 9, 1, 1).ray(2, 3, 0).direction, expected.direction);
  }
}

TEST(CameraRays, DegenerateCamerasAreRefused) {
  const auto refused = [](const auto& change, std::uint32_t width = 4, std::uint32_t samples = 1) {
    Camera camera = forward_camera();
    change(camera);
    EXPECT_THROW(CameraRays(camera, width, 4, samples, 1), UsageError);
  };
  const float nan = std::numeric_limits<float>::quiet_NaN();
  refused([](Camera& camera) { camera.direction = {0, 0, 0}; });
  refused([=](Camera& camera) { camera.direction = {0, nan, 0}; });
  refused([=](Camera& camera) { camera.eye = {nan, 0, 0}; });
  for (const float fov : {0.0f, 180.0f, -20.0f, nan}) refused([=](Camera& camera) { camera.fov = fov; });
  refused([](Camera&) {}, 0);
  refused([](Camera&) {}, 4, 0);
}

TEST(PixelsInTiles, HoldEveryPixelOnceAndKeepNeighboursTogether) {
  const std::vector<std::uint32_t> pixels = pixels_in_tiles(20, 11);
  EXPECT_EQ(std::set(pixels.begin(), pixels.end()).size(), 220u);
  EXPECT_EQ(pixels.size(), 220u);
  EXPECT_EQ(*std::ranges::max_element(pixels), 219u);
  for (std::size_t i = 0; i < 64; ++i) {
    EXPECT_LT(pixels[i] % 20, 8u);
    EXPECT_LT(pixels[i] / 20, 8u);
  }
}

}  // namespace
}  // namespace boxwood
