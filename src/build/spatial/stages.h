#pragma once
#include "recipe/stage.h"

namespace boxwood {

Stage spatial_stage();

}  // namespace boxwood
