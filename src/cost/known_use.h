#pragma once
#include <cstdint>
#include <vector>

#include "boxwood/expected_use.h"

namespace boxwood {

/// A pinhole camera in the space of what is built, which may be stretched against the world: a point is
/// eye + z * (forward + x * right + y * up), and it is in the picture when z > 0 and x, y lie in [-1, 1].
struct Window {
  Vec3 eye, forward, right, up;
};

/// ExpectedUse as builders see it: in the space of what they build, and by primitive.
struct KnownUse {
  std::vector<ExpectedRays> rays;
  std::vector<std::uint8_t> seen;  ///< [primitive]: 1 when some ray ends on it
  std::vector<Window> windows;     ///< one per view and placement
};

}  // namespace boxwood
