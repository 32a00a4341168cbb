#pragma once
#include "recipe/stage.h"

namespace boxwood {

Stage octree_layout_stage();
Stage bit_octree_stage();

}  // namespace boxwood
