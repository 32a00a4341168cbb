#pragma once
#include "boxwood/vec3.h"

namespace boxwood {

/// What distances are computed in. Differences of floats of like size are exact in it.
struct Double3 {
  double x, y, z;
};

inline Double3 difference(const Vec3& a, const Vec3& b) {
  return {double{a.x} - double{b.x}, double{a.y} - double{b.y}, double{a.z} - double{b.z}};
}
inline Double3 operator+(const Double3& a, const Double3& b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
inline Double3 operator-(const Double3& a, const Double3& b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
inline Double3 operator*(const Double3& a, double s) { return {a.x * s, a.y * s, a.z * s}; }
inline double dot(const Double3& a, const Double3& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
inline Double3 cross(const Double3& a, const Double3& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

}  // namespace boxwood
