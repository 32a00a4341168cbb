#pragma once
#include "recipe/stage.h"

namespace boxwood {

Stage ploc_stage();
Stage hlbvh_stage();

}  // namespace boxwood
