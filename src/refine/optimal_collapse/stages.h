#pragma once
#include "recipe/stage.h"

namespace boxwood {

Stage optimal_collapse_stage();

}  // namespace boxwood
