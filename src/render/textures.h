#pragma once
#include <array>

#include "boxwood/scene.h"

namespace boxwood {

/// Linear colour of a texture at texture coordinates (u, v): bilinear, repeated beyond [0, 1). `texture` has pixels.
/// White where u or v is not finite.
Vec3 texture_color(const Texture& texture, double u, double v);

}  // namespace boxwood
