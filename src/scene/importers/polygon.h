#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include "boxwood/scene.h"

namespace boxwood {

/// Cuts a polygon of n >= 3 corners into n - 2 triangles and appends them to `out` as corner numbers 0 … n-1. Ears are
/// cut in order; a polygon that has none left (crossed, flat, not finite) is finished as a fan. O(n) for convex ones,
/// O(n^3) at worst, therefore above 1,000 corners always a fan.
void triangulate_polygon(std::span<const Vec3> corners, std::vector<Triangle>& out);

}  // namespace boxwood
