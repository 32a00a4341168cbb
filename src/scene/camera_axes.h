#pragma once
#include <cstdint>

#include "boxwood/scene.h"

namespace boxwood {

/// Where a pinhole camera looks: the picture is the points eye + forward + x * right + y * up with x, y in [-1, 1].
struct CameraAxes {
  /// An up vector that is zero or parallel to the direction is replaced by the coordinate axis least parallel to it.
  /// Throws UsageError on a direction or eye that is zero (direction only) or not finite, a fov outside (0, 180)
  /// degrees, or a picture without pixels or with more than 2^31.
  CameraAxes(const Camera& camera, std::uint32_t width, std::uint32_t height);

  Vec3 forward;    ///< of unit length
  Vec3 right, up;  ///< reach from the centre to the edge of the picture
};

}  // namespace boxwood
