// Every stage of every recipe, one line each, and the presets. This is the only file that knows them all.
#include "build/morton/stages.h"
#include "build/spatial/stages.h"
#include "build/stages.h"
#include "layout/stages.h"
#include "recipe/stage.h"
#include "refine/optimal_collapse/stages.h"
#include "refine/reinsert/stages.h"
#include "refine/stages.h"

namespace boxwood {

const std::vector<Stage>& stages() {
  static const std::vector<Stage> all = {
      median_stage(),           middle_stage(),   equal_stage(),   sweep_stage(),
      binned_stage(),           ploc_stage(),     spatial_stage(), collapse_stage(),
      optimal_collapse_stage(), reinsert_stage(), binary_stage(),  wide_stage(),
      compressed_stage(),       trace_stage(),
#ifdef BOXWOOD_EMBREE
      embree_stage(),
#endif
  };
  return all;
}

const std::vector<Preset>& presets() {
  static const std::vector<Preset> all = {
      {"fast", "ploc > collapse(8) > wide(8)", "quick to build"},
      {"default", "ploc > reinsert > optimal-collapse(8) > wide(8)", "a good tree, small in memory, quick to build"},
      {"best", "spatial > reinsert > optimal-collapse(8) > wide(8)", "fewest tests per ray; slow to build"},
  };
  return all;
}

}  // namespace boxwood
