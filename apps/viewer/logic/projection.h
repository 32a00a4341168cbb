#pragma once
#include <optional>

#include "boxwood/box.h"
#include "boxwood/scene.h"

namespace boxwood::viewer {

/// A place in a picture, in pixels from its top left corner.
struct PicturePoint {
  float x = 0, y = 0;
};

/// Where world points appear in a picture: the inverse of the camera's rays.
class Projection {
 public:
  Projection(const Camera& camera, float width, float height);

  /// The visible part of a segment; nothing when it lies behind the eye.
  struct Line {
    PicturePoint a, b;
  };
  std::optional<Line> line(Vec3 a, Vec3 b) const;
  std::optional<PicturePoint> point(const Vec3& p) const;

 private:
  Vec3 in_camera(const Vec3& p) const;  // right, up, ahead
  PicturePoint on_picture(const Vec3& seen) const;
  Vec3 eye_, right_, up_, ahead_;
  float width_, height_, scale_;
};

/// The twelve edges of a box as pairs of corners: bit 0 of a corner is x, bit 1 y, bit 2 z; a set bit takes the upper.
inline constexpr int box_edges[12][2] = {{0, 1}, {2, 3}, {4, 5}, {6, 7}, {0, 2}, {1, 3},
                                         {4, 6}, {5, 7}, {0, 4}, {1, 5}, {2, 6}, {3, 7}};
constexpr Vec3 box_corner(const Box& box, int corner) {
  return {corner & 1 ? box.upper.x : box.lower.x, corner & 2 ? box.upper.y : box.lower.y,
          corner & 4 ? box.upper.z : box.lower.z};
}

}  // namespace boxwood::viewer
