#pragma once
#include "recipe/stage.h"

namespace boxwood {

Stage exhaustive_stage();
Stage foresight_stage();

}  // namespace boxwood
