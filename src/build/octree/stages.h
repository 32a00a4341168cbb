#pragma once
#include "recipe/stage.h"

namespace boxwood {

Stage octree_builder_stage();

}  // namespace boxwood
