#pragma once
#include "recipe/stage.h"

namespace boxwood {

Stage order_stage();

}  // namespace boxwood
