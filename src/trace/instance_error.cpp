#include "trace/instance_error.h"

#include <algorithm>
#include <cmath>

namespace boxwood {
namespace {

/// Row `i`, column `j` of the linear part; column 3 is the translation.
double entry(const Transform& t, std::size_t i, std::size_t j) {
  const Vec3& column = j == 0 ? t.x : j == 1 ? t.y : j == 2 ? t.z : t.translation;
  return static_cast<double>(column[i]);
}

double reach_of(const Box& box) {
  double reach = 0;
  for (std::size_t axis = 0; axis < 3 && !box.empty(); ++axis) {
    reach = std::max(
        {reach, std::fabs(static_cast<double>(box.lower[axis])), std::fabs(static_cast<double>(box.upper[axis]))});
  }
  return reach;
}

}  // namespace

InstanceError instance_error(const Transform& object_to_world, const Transform& world_to_object,
                             const Box& object_box) {
  // The box test's bound is 2^-19 of its magnitude; a residual must be scaled up to count in full.
  constexpr double per_unit_of_bound = 0x1p19;
  const double reach = reach_of(object_box);
  double gain = 1, offset = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    double row_gain = 0, row_offset = std::fabs(entry(object_to_world, i, 3));
    for (std::size_t k = 0; k < 3; ++k) {
      row_offset += std::fabs(entry(object_to_world, i, k)) * (std::fabs(entry(world_to_object, k, 3)) + 2 * reach);
    }
    for (std::size_t j = 0; j < 4; ++j) {
      double product = j == 3 ? entry(object_to_world, i, 3) : i == j ? -1.0 : 0.0, size = 0;
      for (std::size_t k = 0; k < 3; ++k) {
        const double term = entry(object_to_world, i, k) * entry(world_to_object, k, j);
        product += term;
        size += std::fabs(term);
      }
      (j == 3 ? row_offset : row_gain) += (j == 3 ? 0 : size) + std::fabs(product) * per_unit_of_bound;
    }
    gain = std::max(gain, row_gain);
    offset = std::max(offset, row_offset);
  }
  // Twice: once for the ray's own rounding on the way in, once for the triangle test behind it.
  return {static_cast<float>(2 * gain), static_cast<float>(2 * offset)};
}

}  // namespace boxwood
