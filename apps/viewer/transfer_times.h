#pragma once
#include <string>

namespace boxwood::viewer {

/// How long a picture of this size takes to the graphics card, in both ways, interleaved: a sentence with the medians.
/// Opens a window. Throws Error without a display.
std::string transfer_times(int width, int height);

}  // namespace boxwood::viewer
