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

InstanceError instance_error(const Transform& object_to_world, const Transform& world_to_object, const Box& object_box,
                             Reach below) {
  // The box test's bound is 2^-19 of its magnitude; a residual must be scaled up to count in full.
  constexpr double per_unit_of_bound = 0x1p19;
  const double reach = std::max(reach_of(object_box), static_cast<double>(below.reach));
  // An error in the object's space is relative to the largest coordinate there, whichever that is.
  double object_gain = 0, object_offset = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    double row = 0;
    for (std::size_t j = 0; j < 3; ++j) row += std::fabs(entry(world_to_object, k, j));
    object_gain = std::max(object_gain, row);
    object_offset = std::max(object_offset, std::fabs(entry(world_to_object, k, 3)) + 2 * reach);
  }
  double gain = 1, offset = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    double row_gain = 0, row_offset = std::fabs(entry(object_to_world, i, 3));
    for (std::size_t k = 0; k < 3; ++k) {
      row_gain += std::fabs(entry(object_to_world, i, k)) * object_gain;
      row_offset += std::fabs(entry(object_to_world, i, k)) * object_offset;
    }
    for (std::size_t j = 0; j < 4; ++j) {
      double residual = j == 3 ? entry(object_to_world, i, 3) : i == j ? -1.0 : 0.0;
      for (std::size_t k = 0; k < 3; ++k) residual += entry(object_to_world, i, k) * entry(world_to_object, k, j);
      (j == 3 ? row_offset : row_gain) += std::fabs(residual) * per_unit_of_bound;
    }
    gain = std::max(gain, row_gain);
    offset = std::max(offset, row_offset);
  }
  // Once for the ray's own rounding on the way in, and once, or what is placed says how often, for what is behind it.
  const double times = 1 + static_cast<double>(below.gain);
  return {static_cast<float>(times * gain), static_cast<float>(times * offset)};
}

}  // namespace boxwood
