#pragma once
#include "recipe/stage.h"

namespace boxwood {

Stage pca_stage();
Stage combined_stage();
Stage distance_stage();

}  // namespace boxwood
