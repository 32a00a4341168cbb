#pragma once
#include "recipe/stage.h"

namespace boxwood {

Stage median_stage();
Stage middle_stage();
Stage equal_stage();
Stage sweep_stage();
Stage binned_stage();

}  // namespace boxwood
