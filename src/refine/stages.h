#pragma once
#include "recipe/stage.h"

namespace boxwood {

Stage collapse_stage();

}  // namespace boxwood
