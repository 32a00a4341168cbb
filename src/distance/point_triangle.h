#pragma once
#include "distance/double3.h"
#include "distance/placed_triangle.h"

namespace boxwood {

/// Where a triangle is nearest to a point.
struct OnTriangle {
  double squared_distance;
  double u, v;     ///< barycentric weights of b and c
  Double3 offset;  ///< from the point
};

OnTriangle nearest_on(const PlacedTriangle& triangle, const Vec3& point);

/// Squared distance of a point to a box; 0 inside.
inline double squared_distance(const Box& box, const Vec3& point) {
  double sum = 0;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const double p = point[axis], below = double{box.lower[axis]} - p, above = p - double{box.upper[axis]};
    const double outside = below > above ? below : above;
    if (outside > 0) sum += outside * outside;
  }
  return sum;
}

}  // namespace boxwood
