#pragma once
#include "recipe/stage.h"

namespace boxwood {

Stage rotate_stage();

}  // namespace boxwood
