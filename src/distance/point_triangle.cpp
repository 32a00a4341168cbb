// The nearest point of a triangle: the foot of the perpendicular where it lies inside, else the nearest of three edges.
// All are computed, so that no rounding can pick the wrong region of a thin triangle.
#include "distance/point_triangle.h"

#include <algorithm>

namespace boxwood {
namespace {

struct OnEdge {
  double squared_distance, s;  ///< at p + s * (q - p)
  Double3 offset;
};

/// From the origin.
OnEdge nearest_on_edge(const Double3& p, const Double3& q) {
  const Double3 edge = q - p;
  const double length = dot(edge, edge);
  const double s = length > 0 ? std::clamp(-dot(p, edge) / length, 0.0, 1.0) : 0.0;
  // From the nearer end, whose rounding is smaller.
  const Double3 offset = s <= 0.5 ? p + edge * s : q - edge * (1 - s);
  return {dot(offset, offset), s, offset};
}

}  // namespace

OnTriangle nearest_on(const PlacedTriangle& triangle, const Vec3& point) {
  const Double3 a = difference(triangle.a, point), b = difference(triangle.b, point), c = difference(triangle.c, point);
  const OnEdge ab = nearest_on_edge(a, b), bc = nearest_on_edge(b, c), ca = nearest_on_edge(c, a);
  OnTriangle best{ab.squared_distance, ab.s, 0, ab.offset};
  if (bc.squared_distance < best.squared_distance) best = {bc.squared_distance, 1 - bc.s, bc.s, bc.offset};
  if (ca.squared_distance < best.squared_distance) best = {ca.squared_distance, 0, 1 - ca.s, ca.offset};

  const Double3 normal = cross(b - a, c - a);
  const double size = dot(normal, normal);
  if (!(size > 0)) return best;
  const double weight_a = dot(normal, cross(b, c)), weight_b = dot(normal, cross(c, a)),
               weight_c = dot(normal, cross(a, b));
  if (weight_a < 0 || weight_b < 0 || weight_c < 0) return best;
  const double height = dot(normal, a);
  const Double3 foot = normal * (height / size);
  const double squared = height / size * height;
  if (squared < best.squared_distance) best = {squared, weight_b / size, weight_c / size, foot};
  return best;
}

}  // namespace boxwood
