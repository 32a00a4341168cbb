// SAH alternatives study, section 2.7, equation 10.
#include <cmath>
#include <numbers>

#include "cost/scene_interior.h"

namespace boxwood {
namespace {

/// Solid angle of the rectangle [u.low, u.high] x [v.low, v.high] seen from `distance` > 0 above the origin.
double rectangle_angle(double u_low, double u_high, double v_low, double v_high, double distance) {
  const auto corner = [&](double u, double v) {
    return std::atan2(u * v, distance * std::sqrt(u * u + v * v + distance * distance));
  };
  return corner(u_high, v_high) - corner(u_low, v_high) - corner(u_high, v_low) + corner(u_low, v_low);
}

}  // namespace

double InteriorHq::reached_volume(const Ranges& node) const {
  // Where a cell lies on one axis: below the node, beside it, above it.
  struct Part {
    double size, center, distance;  // distance from the centre to the node's face that it sees; 0 beside the node
  };
  Part parts[3][3];
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const Range s = scene()[axis], n = node[axis];
    const double below = (s.low + n.low) / 2, above = (n.high + s.high) / 2;
    parts[axis][0] = {n.low - s.low, below, n.low - below};
    parts[axis][1] = {n.size(), (n.low + n.high) / 2, 0};
    parts[axis][2] = {s.high - n.high, above, above - n.high};
  }
  double sum = node[0].size() * node[1].size() * node[2].size();
  for (int cell = 0; cell < 27; ++cell) {
    if (cell == 13) continue;  // the node itself
    const Part* part[3] = {&parts[0][cell % 3], &parts[1][cell / 3 % 3], &parts[2][cell / 9]};
    const double volume = part[0]->size * part[1]->size * part[2]->size;
    if (volume <= 0) continue;
    // A convex body's solid angle is that of the faces that can be seen.
    double angle = 0;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      if (part[axis]->distance <= 0) continue;
      const std::size_t u = (axis + 1) % 3, v = (axis + 2) % 3;
      angle += rectangle_angle(node[u].low - part[u]->center, node[u].high - part[u]->center,
                               node[v].low - part[v]->center, node[v].high - part[v]->center, part[axis]->distance);
    }
    sum += volume * angle / (4 * std::numbers::pi);
  }
  return sum;
}

}  // namespace boxwood
