#pragma once
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <string>
#include <vector>

#include "boxwood/scene.h"
#include "boxwood/structure.h"
#include "math/random.h"

namespace boxwood::testing_scenes {

/// The cube [-1, 1]^3, normals outward.
inline Scene box_scene() {
  std::vector<Vec3> corners;
  for (int i = 0; i < 8; ++i) corners.push_back({i & 1 ? 1.f : -1.f, i & 2 ? 1.f : -1.f, i & 4 ? 1.f : -1.f});
  Scene scene;
  scene.add_mesh(corners, {{0, 2, 1},
                           {1, 2, 3},
                           {4, 5, 6},
                           {5, 7, 6},
                           {0, 1, 4},
                           {1, 5, 4},
                           {2, 6, 3},
                           {3, 6, 7},
                           {0, 4, 2},
                           {2, 4, 6},
                           {1, 3, 5},
                           {3, 7, 5}});
  return scene;
}

/// The square [-1, 1]^2 at `height`, normal upward along y.
inline Scene plane_scene(float height = 0) {
  Scene scene;
  scene.add_mesh({{-1, height, -1}, {1, height, -1}, {1, height, 1}, {-1, height, 1}}, {{0, 2, 1}, {0, 3, 2}});
  return scene;
}

/// Small random triangles in [-1, 1]^3 that overlap in any view.
inline Scene soup_scene(std::uint32_t triangles = 300) {
  Random random(7);
  const auto coordinate = [&](float size) { return random.uniform(-size, size); };
  std::vector<Vec3> positions;
  std::vector<Triangle> indices;
  for (std::uint32_t i = 0; i < triangles; ++i) {
    const Vec3 center{coordinate(1), coordinate(1), coordinate(1)};
    for (int corner = 0; corner < 3; ++corner) {
      positions.push_back(center + Vec3{coordinate(0.2f), coordinate(0.2f), coordinate(0.2f)});
    }
    indices.push_back({3 * i, 3 * i + 1, 3 * i + 2});
  }
  Scene scene;
  scene.add_mesh(positions, indices);
  return scene;
}

/// Two instances of one box, the second stretched, mirrored and moved.
inline Scene instanced_scene() {
  Scene scene = box_scene();
  scene.instances.push_back({0, Transform::translate({4, 0, 0}) * Transform::scale({-1, 2, 0.5f})});
  return scene;
}

/// Looks at the origin from a corner outside [-1, 1]^3.
inline Camera outside_camera() { return {"outside", {2, 3, 4}, {-2, -3, -4}, {0, 1, 0}, 40}; }

/// A folder of one's own, gone afterwards.
class ScratchFolder {
 public:
  ScratchFolder() {
    const auto* test = ::testing::UnitTest::GetInstance()->current_test_info();
    path_ = std::filesystem::temp_directory_path() /
            (std::string("boxwood-") + test->name() + "-" + std::to_string(getpid()));
    std::filesystem::create_directories(path_);
  }
  ~ScratchFolder() { std::filesystem::remove_all(path_); }
  ScratchFolder(const ScratchFolder&) = delete;
  ScratchFolder& operator=(const ScratchFolder&) = delete;

  std::filesystem::path file(const std::string& name) const { return path_ / name; }
  std::size_t entries() const {
    return static_cast<std::size_t>(
        std::distance(std::filesystem::directory_iterator(path_), std::filesystem::directory_iterator()));
  }

 private:
  std::filesystem::path path_;
};

}  // namespace boxwood::testing_scenes
