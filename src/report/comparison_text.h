#pragma once
#include <string>

#include "measure/compare.h"

namespace boxwood {

/// One table of what the structures are, then one per ray kind of how fast they trace it and why. Fits 120 columns with
/// recipes of up to 50 characters.
std::string comparison_text(const Comparison& comparison);

}  // namespace boxwood
