#pragma once
#include "recipe/stage.h"

namespace boxwood {

Stage srdh_stage();

}  // namespace boxwood
