#pragma once
#include "recipe/stage.h"

namespace boxwood {

Stage rebraid_stage();

}  // namespace boxwood
