#pragma once
#include "boxwood/box.h"
#include "cost/known_use.h"

namespace boxwood {

/// How much of a camera's picture a box covers.
class Picture {
 public:
  static constexpr double area = 4;  ///< x and y run from -1 to 1

  explicit Picture(const Window& window);

  /// Of a box that holds the eye: all. Else of the faces that the eye sees, clipped to the picture; faces of a convex
  /// body do not hide each other. Never more for a box than for one that contains it, but for rounding.
  double area_covered(const Box& box) const;

  /// What the study measured: the hull of the eight corners divided by their depth, whatever its sign, clipped to the
  /// picture. Of a box that holds the eye: all.
  double area_of_projected_corners(const Box& box) const;

 private:
  /// A point is (x / z, y / z) in the picture, and before the eye when z > 0.
  struct Point {
    double x, y, z;
  };
  class Polygon;
  Point project(double x, double y, double z) const;
  bool eye_in(const Box& box) const;

  Vec3 eye_;
  Vec3 rows_[3];
};

}  // namespace boxwood
