// SAH alternatives study, section 2.7, equation 10.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "cost/scene_interior.h"

namespace boxwood {
namespace {

/// A sum of angles, kept as the product of complex numbers of those angles: one arctangent for all of them, where a
/// node of a build would need hundreds. The sum must lie in [0, 2 pi).
class AngleSum {
 public:
  /// Adds the angle of (x, y).
  void add(double x, double y) {
    const double turned = x_ * x - y_ * y;
    y_ = x_ * y + y_ * x;
    x_ = turned;
  }
  /// Keeps the products of many large numbers in range.
  void shrink() {
    const double scale = 1 / std::sqrt(x_ * x_ + y_ * y_);
    x_ *= scale;
    y_ *= scale;
  }
  double angle() const {
    const double within_half_turn = std::atan2(y_, x_);
    // Rounding may put an angle of nothing a little below zero.
    return within_half_turn < -1e-12 ? within_half_turn + 2 * std::numbers::pi : std::max(0.0, within_half_turn);
  }

 private:
  double x_ = 1, y_ = 0;
};

/// Adds the solid angle of the rectangle [u.low, u.high] x [v.low, v.high] seen from `distance` > 0 above the origin.
void add_rectangle(AngleSum& sum, double u_low, double u_high, double v_low, double v_high, double distance) {
  const double scale = 1 / (distance * distance);
  const auto corner = [&](double u, double v, double sign) {
    // Each term over the distance squared keeps the sizes near 1.
    sum.add(std::sqrt((u * u + v * v) * scale + 1), sign * u * v * scale);
  };
  corner(u_high, v_high, 1);
  corner(u_low, v_high, -1);
  corner(u_high, v_low, -1);
  corner(u_low, v_low, 1);
  sum.shrink();
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
    // A convex body's solid angle is that of the faces that can be seen; from outside it, less than a half sphere.
    AngleSum angle;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      if (part[axis]->distance <= 0) continue;
      const std::size_t u = (axis + 1) % 3, v = (axis + 2) % 3;
      add_rectangle(angle, node[u].low - part[u]->center, node[u].high - part[u]->center, node[v].low - part[v]->center,
                    node[v].high - part[v]->center, part[axis]->distance);
    }
    sum += volume * angle.angle() / (4 * std::numbers::pi);
  }
  return sum;
}

}  // namespace boxwood
