#pragma once
#include <cstdint>

#include "boxwood/distance.h"

namespace boxwood {

/// A triangle of an instance in world space. 48 bytes: three vertices, its name, whether b and c have changed places,
/// which keeps the outside of a mirrored instance outside.
struct PlacedTriangle {
  Vec3 a, b, c;
  TriangleName name;
  std::uint32_t turned = 0;
};
static_assert(sizeof(PlacedTriangle) == 48);

}  // namespace boxwood
