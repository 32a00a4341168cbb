#include "cost/picture.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace boxwood {

/// Convex.
class Picture::Polygon {
 public:
  void add(const Point& p) { corners_[size_++] = p; }

  /// Keeps what has x, y in the picture and z above 0. Sutherland and Hodgman 1974.
  void clip_to_picture() {
    clip({1, 0, 1});
    clip({-1, 0, 1});
    clip({0, 1, 1});
    clip({0, -1, 1});
  }

  double area_in_picture() const {
    double twice = 0;
    for (std::size_t i = 0; i < size_; ++i) {
      const Point a = divided(corners_[i]), b = divided(corners_[next(i)]);
      twice += a.x * b.y - b.x * a.y;
    }
    return std::min(std::fabs(twice) / 2, Picture::area);
  }

 private:
  std::size_t next(std::size_t i) const { return i + 1 < size_ ? i + 1 : 0; }

  /// After clipping only rounding can leave the picture.
  static Point divided(const Point& p) {
    if (!(p.z > 0)) return {0, 0, 1};
    return {std::clamp(p.x / p.z, -1.0, 1.0), std::clamp(p.y / p.z, -1.0, 1.0), 1};
  }

  void clip(const Point& plane) {
    const auto side = [&](const Point& p) { return plane.x * p.x + plane.y * p.y + plane.z * p.z; };
    Polygon kept;
    for (std::size_t i = 0; i < size_; ++i) {
      const Point &a = corners_[i], &b = corners_[next(i)];
      const double at_a = side(a), at_b = side(b);
      if (at_a >= 0) kept.add(a);
      if ((at_a >= 0) == (at_b >= 0)) continue;
      const double t = at_a / (at_a - at_b);
      kept.add({a.x + t * (b.x - a.x), a.y + t * (b.y - a.y), a.z + t * (b.z - a.z)});
    }
    *this = kept;
  }

  std::array<Point, 16> corners_{};
  std::size_t size_ = 0;
};

Picture::Picture(const Window& window) : eye_(window.eye) {
  // Rows of the inverse of (right, up, forward) times its determinant's size, which cancels in x / z and y / z.
  const float sign = dot(cross(window.right, window.up), window.forward) < 0 ? -1.0f : 1.0f;
  rows_[0] = cross(window.up, window.forward) * sign;
  rows_[1] = cross(window.forward, window.right) * sign;
  rows_[2] = cross(window.right, window.up) * sign;
}

Picture::Point Picture::project(double x, double y, double z) const {
  const double d[3] = {x - eye_.x, y - eye_.y, z - eye_.z};
  const auto along = [&](const Vec3& row) { return row.x * d[0] + row.y * d[1] + row.z * d[2]; };
  return {along(rows_[0]), along(rows_[1]), along(rows_[2])};
}

bool Picture::eye_in(const Box& box) const { return box.contains(Box{eye_, eye_}); }

double Picture::area_covered(const Box& box) const {
  if (box.empty()) return 0;
  if (eye_in(box)) return area;
  double sum = 0;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const bool below = eye_[axis] < box.lower[axis];
    if (!below && !(eye_[axis] > box.upper[axis])) continue;
    const std::size_t u = (axis + 1) % 3, v = (axis + 2) % 3;
    Polygon face;
    for (const auto& [u_upper, v_upper] : {std::pair(0, 0), {1, 0}, {1, 1}, {0, 1}}) {
      Vec3 p;
      p[axis] = below ? box.lower[axis] : box.upper[axis];
      p[u] = u_upper ? box.upper[u] : box.lower[u];
      p[v] = v_upper ? box.upper[v] : box.lower[v];
      face.add(project(p.x, p.y, p.z));
    }
    face.clip_to_picture();
    sum += face.area_in_picture();
  }
  return std::min(sum, area);
}

double Picture::area_of_projected_corners(const Box& box) const {
  if (box.empty()) return 0;
  if (eye_in(box)) return area;
  std::array<Point, 8> corners;
  for (unsigned i = 0; i < 8; ++i) {
    Point p = project(i & 1 ? box.upper.x : box.lower.x, i & 2 ? box.upper.y : box.lower.y,
                      i & 4 ? box.upper.z : box.lower.z);
    if (p.z == 0) p.z = 1e-30;
    corners[i] = {p.x / p.z, p.y / p.z, 1};
  }
  // Convex hull, lower chain then upper (Andrew 1979).
  std::ranges::sort(corners, [](const Point& a, const Point& b) { return a.x != b.x ? a.x < b.x : a.y < b.y; });
  std::array<Point, 17> hull;
  std::size_t size = 0;
  const auto add = [&](const Point& p, std::size_t chain) {
    const auto turns_right = [&] {
      const Point &a = hull[size - 2], &b = hull[size - 1];
      return (b.x - a.x) * (p.y - a.y) - (b.y - a.y) * (p.x - a.x) <= 0;
    };
    while (size >= chain + 2 && turns_right()) --size;
    hull[size++] = p;
  };
  for (const Point& p : corners) add(p, 0);
  const std::size_t upper = size - 1;
  for (std::size_t i = corners.size() - 1; i-- > 0;) add(corners[i], upper);
  Polygon outline;
  for (std::size_t i = 0; i + 1 < size; ++i) outline.add(hull[i]);
  outline.clip_to_picture();
  return outline.area_in_picture();
}

}  // namespace boxwood
