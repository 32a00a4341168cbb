#pragma once
#include "recipe/stage.h"

namespace boxwood {

Stage reinsert_stage();

}  // namespace boxwood
