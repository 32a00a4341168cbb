#pragma once
#include "recipe/stage.h"

namespace boxwood {

Stage binary_stage();
Stage wide_stage();
Stage compressed_stage();
Stage slab_stage();
Stage binary_split_stage();
Stage wide_slab_stage();
Stage bih_stage();
Stage oriented_stage();
Stage trace_stage();
#ifdef BOXWOOD_EMBREE
Stage embree_stage();
#endif

}  // namespace boxwood
