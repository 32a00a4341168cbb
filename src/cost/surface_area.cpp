#include "cost/surface_area.h"

namespace boxwood {

void SurfaceArea::probabilities(const Node& parent, std::span<const Side> sides, std::span<float> out) const {
  const float area = half_area(parent.box);
  for (std::size_t i = 0; i < sides.size(); ++i) out[i] = area > 0 ? half_area(sides[i].box) / area : 1;
}

}  // namespace boxwood
