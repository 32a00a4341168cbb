// Ear clipping (Meisters 1975) in the plane that the polygon leans on most.
#include "scene/importers/polygon.h"

#include <cmath>
#include <numeric>

namespace boxwood {
namespace {

constexpr std::size_t most_clipped_corners = 1'000;

struct Point {
  double x, y;
};

double twice_area(const Point& a, const Point& b, const Point& c) {
  return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

/// Drops the axis along which the polygon's normal (Newell) is longest, so that it runs counter-clockwise.
std::vector<Point> project(std::span<const Vec3> corners) {
  double normal[3] = {0, 0, 0};
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const Vec3 &p = corners[i], &q = corners[(i + 1) % corners.size()];
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const std::size_t u = (axis + 1) % 3, v = (axis + 2) % 3;
      normal[axis] += (static_cast<double>(p[u]) - static_cast<double>(q[u])) *
                      (static_cast<double>(p[v]) + static_cast<double>(q[v]));
    }
  }
  const double ax = std::fabs(normal[0]), ay = std::fabs(normal[1]), az = std::fabs(normal[2]);
  const std::size_t dropped = ax > ay && ax > az ? 0 : ay > az ? 1 : 2;
  const std::size_t u = (dropped + 1) % 3, v = (dropped + 2) % 3;
  std::vector<Point> points;
  for (const Vec3& corner : corners) {
    const auto pu = static_cast<double>(corner[u]), pv = static_cast<double>(corner[v]);
    points.push_back(normal[dropped] < 0 ? Point{pv, pu} : Point{pu, pv});
  }
  return points;
}

bool is_ear(std::span<const Point> points, std::span<const std::uint32_t> ring, std::size_t tip) {
  const std::size_t before = (tip + ring.size() - 1) % ring.size(), after = (tip + 1) % ring.size();
  const Point &a = points[ring[before]], &b = points[ring[tip]], &c = points[ring[after]];
  if (!(twice_area(a, b, c) > 0)) return false;
  for (std::size_t i = 0; i < ring.size(); ++i) {
    if (i == before || i == tip || i == after) continue;
    const Point& p = points[ring[i]];
    if (twice_area(a, b, p) >= 0 && twice_area(b, c, p) >= 0 && twice_area(c, a, p) >= 0) return false;
  }
  return true;
}

bool is_convex(std::span<const Point> points) {
  const std::size_t n = points.size();
  for (std::size_t i = 0; i < n; ++i) {
    if (!(twice_area(points[i], points[(i + 1) % n], points[(i + 2) % n]) >= 0)) return false;
  }
  return true;
}

void append_fan(std::span<const std::uint32_t> ring, std::vector<Triangle>& out) {
  for (std::size_t i = 1; i + 1 < ring.size(); ++i) out.push_back({ring[0], ring[i], ring[i + 1]});
}

}  // namespace

void triangulate_polygon(std::span<const Vec3> corners, std::vector<Triangle>& out) {
  std::vector<std::uint32_t> ring(corners.size());
  std::iota(ring.begin(), ring.end(), 0u);
  if (ring.size() > 3 && ring.size() <= most_clipped_corners) {
    const std::vector<Point> points = project(corners);
    if (is_convex(points)) return append_fan(ring, out);
    for (std::size_t tip = 0; tip < ring.size() && ring.size() > 3;) {
      if (!is_ear(points, ring, tip)) {
        ++tip;
        continue;
      }
      const std::size_t n = ring.size();
      out.push_back({ring[(tip + n - 1) % n], ring[tip], ring[(tip + 1) % n]});
      ring.erase(ring.begin() + static_cast<std::ptrdiff_t>(tip));
      tip = 0;
    }
  }
  append_fan(ring, out);
}

}  // namespace boxwood
