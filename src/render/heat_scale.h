#pragma once
#include "render/image.h"

namespace boxwood {

/// The count that nearly all pixels of a heat map do not exceed: a few outliers would leave the rest dark. 0 for an
/// image without pixels.
float usual_maximum(const Image& counts);

/// Divided by `scale`, so that it shows at full brightness; as it is when scale is 0.
Image scaled(Image counts, float scale);

}  // namespace boxwood
