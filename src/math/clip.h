#pragma once
#include "boxwood/box.h"

namespace boxwood {

/// Box of the part of triangle abc that lies in `region`; empty when nothing does. Never smaller than the exact box:
/// cut points are widened by their rounding error, then kept inside `region`. Sutherland and Hodgman 1974, axis by
/// axis.
Box clip_triangle(const Vec3& a, const Vec3& b, const Vec3& c, const Box& region);

}  // namespace boxwood
