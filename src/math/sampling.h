#pragma once
#include <cmath>
#include <numbers>

#include "boxwood/transform.h"
#include "boxwood/vec3.h"

namespace boxwood {

inline constexpr float pi = std::numbers::pi_v<float>;

struct SineCosine {
  double sine, cosine;
};

/// Sine and cosine of an angle given in full turns, within 1e-13, with the same bits on every machine (the C library's
/// differ between machines). |turns| below 2^40.
constexpr SineCosine sine_cosine_of_turns(double turns) {
  // Nearest quarter turn, then Taylor series for the rest, at most an eighth of a turn.
  const double quarters = turns * 4;
  const auto nearest = static_cast<long long>(quarters < 0 ? quarters - 0.5 : quarters + 0.5);
  const double x = (quarters - static_cast<double>(nearest)) * (std::numbers::pi / 2);
  const double x2 = x * x;
  double sine = 0, cosine = 0;
  for (int n = 14; n >= 2; n -= 2) {
    cosine = (1 - cosine) * x2 / (n * (n - 1));
    sine = (1 - sine) * x2 / (n * (n + 1));
  }
  sine = x * (1 - sine);
  cosine = 1 - cosine;
  switch (nearest & 3) {
    case 0:
      return {sine, cosine};
    case 1:
      return {cosine, -sine};
    case 2:
      return {-sine, -cosine};
    default:
      return {-cosine, sine};
  }
}

// Each map takes two uniform numbers in [0, 1) and keeps their stratification. Directions are of unit length.

/// Uniform over all directions.
inline Vec3 uniform_sphere(float u, float v) {
  const float z = 1 - 2 * u;
  const float radius = std::sqrt(1 - z * z > 0 ? 1 - z * z : 0);
  const SineCosine around = sine_cosine_of_turns(static_cast<double>(v));
  return {radius * static_cast<float>(around.cosine), radius * static_cast<float>(around.sine), z};
}

/// Uniform over the directions with z >= 0; density 1 / (2 pi).
inline Vec3 uniform_hemisphere(float u, float v) { return uniform_sphere(u * 0.5f, v); }

/// Over the directions with z > 0 with density z / pi (Malley's method).
inline Vec3 cosine_hemisphere(float u, float v) {
  const float radius = std::sqrt(u);
  const SineCosine around = sine_cosine_of_turns(static_cast<double>(v));
  return {radius * static_cast<float>(around.cosine), radius * static_cast<float>(around.sine), std::sqrt(1 - u)};
}

/// Two unit vectors that make a right-handed basis with the unit vector `normal`: x, y, normal. No branch cuts except
/// at the sign of normal.z. Duff et al. 2017, "Building an Orthonormal Basis, Revisited".
struct Basis {
  Vec3 x, y, normal;

  explicit Basis(const Vec3& unit_normal) : normal(unit_normal) {
    const float sign = std::copysign(1.0f, normal.z);
    const float a = -1 / (sign + normal.z);
    const float b = normal.x * normal.y * a;
    x = {1 + sign * normal.x * normal.x * a, sign * b, -sign * normal.x};
    y = {b, sign + normal.y * normal.y * a, -normal.y};
  }
  /// A direction given around +z, turned to lie around the normal.
  Vec3 around_normal(const Vec3& local) const { return x * local.x + y * local.y + normal * local.z; }
};

/// Uniform over all rotations, from three uniform numbers in [0, 1) (Shoemake 1992, "Uniform random rotations").
inline Transform uniform_rotation(float u, float v, float w) {
  const float one = std::sqrt(1 - u), two = std::sqrt(u);
  const SineCosine first = sine_cosine_of_turns(static_cast<double>(v));
  const SineCosine second = sine_cosine_of_turns(static_cast<double>(w));
  const float x = one * static_cast<float>(first.sine), y = one * static_cast<float>(first.cosine);
  const float z = two * static_cast<float>(second.sine), r = two * static_cast<float>(second.cosine);
  return {{1 - 2 * (y * y + z * z), 2 * (x * y + z * r), 2 * (x * z - y * r)},
          {2 * (x * y - z * r), 1 - 2 * (x * x + z * z), 2 * (y * z + x * r)},
          {2 * (x * z + y * r), 2 * (y * z - x * r), 1 - 2 * (x * x + y * y)},
          {}};
}

}  // namespace boxwood
