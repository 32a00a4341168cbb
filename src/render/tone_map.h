#pragma once
#include <optional>

#include "render/image.h"

namespace boxwood {

/// Radiance of any brightness to [0, 1] for display: the global operator of Reinhard et al. 2002 ("Photographic Tone
/// Reproduction for Digital Images") on luminance, so colours keep their hue. `exposure` in stops doubles the light for
/// each; without one, the geometric mean of what is not black becomes middle grey, 0.18. O(pixels).
Image map_tones(const Image& radiance, std::optional<float> exposure);

}  // namespace boxwood
