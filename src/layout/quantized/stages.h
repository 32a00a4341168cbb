#pragma once
#include "recipe/stage.h"

namespace boxwood {

Stage quantized_stage();

}  // namespace boxwood
