// Every stage of every recipe, one line each, and the presets. This is the only file that knows them all.
#include <hwy/targets.h>

#include "build/exhaustive/stages.h"
#include "build/morton/stages.h"
#include "build/octree/stages.h"
#include "build/pca/stages.h"
#include "build/spatial/stages.h"
#include "build/srdh/stages.h"
#include "build/stages.h"
#include "layout/octree/stages.h"
#include "layout/quantized/stages.h"
#include "layout/stages.h"
#include "recipe/stage.h"
#include "refine/optimal_collapse/stages.h"
#include "refine/order/stages.h"
#include "refine/rebraid/stages.h"
#include "refine/reinsert/stages.h"
#include "refine/rotate/stages.h"
#include "refine/stages.h"

namespace boxwood {

const std::vector<Stage>& stages() {
  static const std::vector<Stage> all = {
      // clang-format off
      median_stage(),
      middle_stage(),
      equal_stage(),
      sweep_stage(),
      binned_stage(),
      ploc_stage(),
      exhaustive_stage(),
      foresight_stage(),
      srdh_stage(),
      spatial_stage(),
      octree_builder_stage(),
      pca_stage(),
      combined_stage(),
      distance_stage(),
      hlbvh_stage(),
      collapse_stage(),
      optimal_collapse_stage(),
      reinsert_stage(),
      rotate_stage(),
      order_stage(),
      rebraid_stage(),
      binary_stage(),
      wide_stage(),
      compressed_stage(),
      slab_stage(),
      binary_split_stage(),
      wide_slab_stage(),
      bih_stage(),
      octree_layout_stage(),
      bit_octree_stage(),
      quantized_stage(),
      oriented_stage(),
      trace_stage(),
  // clang-format on
#ifdef BOXWOOD_EMBREE
      embree_stage(),
#endif
  };
  return all;
}

const std::string& text_here(const Preset& preset) {
  static const bool has_avx512 = (hwy::SupportedTargets() & HWY_AVX3) != 0;
  return has_avx512 && !preset.text_avx512.empty() ? preset.text_avx512 : preset.text;
}

const std::vector<Preset>& presets() {
  static const std::vector<Preset> all = {
      {"fast", "ploc(radius=4, block=4, run=4, slack=1.5, group=8, width=8) > wide(8)", "quick to build",
       "ploc(radius=2, leaf=8, block=8, run=8, slack=2, group=16, width=16) > wide(16)"},
      {"default", "ploc(block=4, run=4, slack=2.5) > reinsert > optimal-collapse(8) > wide(8)",
       "a good tree, small in memory, quick to build",
       "ploc(leaf=8, block=8, run=8, slack=1.3) > reinsert(rounds=1) > optimal-collapse(16, leaf=8, block=8) > "
       "wide(16)"},
      {"best", "spatial(alpha=0.001, bins=8, block=4) > reinsert > optimal-collapse(8) > wide(8)",
       "fewest tests per ray; slow to build",
       "spatial(alpha=0.001, bins=8, leaf=8, block=8) > reinsert > optimal-collapse(16, leaf=8, block=8) > wide(16)"},
      {"compact", "ploc(block=4, run=4) > reinsert > optimal-collapse(8, leaf=8, block=8) > compressed(8, bytes=22)",
       "least memory, slower rays; the scene must outlive the structure",
       "ploc(leaf=8, block=8, run=8) > reinsert > optimal-collapse(16, leaf=8, block=8) > compressed(16, bytes=22)"},
  };
  return all;
}

}  // namespace boxwood
