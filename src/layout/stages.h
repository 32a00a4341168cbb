#pragma once
#include "recipe/stage.h"

namespace boxwood {

Stage binary_stage();
Stage wide_stage();
Stage compressed_stage();
Stage trace_stage();
#ifdef BOXWOOD_EMBREE
Stage embree_stage();
#endif

}  // namespace boxwood
