#pragma once
#include "recipe/stage.h"

namespace boxwood {

Stage ploc_stage();

}  // namespace boxwood
