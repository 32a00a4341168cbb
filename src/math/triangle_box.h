#pragma once
#include "boxwood/box.h"

namespace boxwood {

/// Whether triangle abc, whose own box meets `box`, comes within `slack` of it. Never says no when they touch: in
/// doubles, whose rounding is far below a slack of 2^-30 of the coordinates. Separating axes, after Akenine-Möller
/// 2001, "Fast 3D Triangle-Box Overlap Testing", without the axes of the box, which the boxes tell.
bool triangle_meets_box(const Vec3& a, const Vec3& b, const Vec3& c, const Box& box, float slack);

}  // namespace boxwood
