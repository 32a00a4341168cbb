// Partial re-braiding, after Benthin, Woop, Wald, Áfra 2017, "Improved Two-Level BVHs using Partial Re-Braiding". What
// it does is done above the trees of meshes (structure/opened_instances.h); those it leaves as they are.
#include "refine/rebraid/stages.h"

namespace boxwood {
namespace {

struct RebraidOptions {
  float references = 2;
};

Tree keep(const RebraidOptions&, Tree tree) { return tree; }

}  // namespace

Stage rebraid_stage() {
  OptionsOf<RebraidOptions> options;
  options.real("references", &RebraidOptions::references, 1, 64, "to parts of meshes, at most, per instance");
  Stage stage =
      refinement_stage<RebraidOptions>("rebraid", "of overlapping instances, parts are placed instead of the whole",
                                       "Benthin et al. 2017", options, keep, nullptr);
  stage.references_per_instance = [](const std::any& call) {
    return std::any_cast<const RebraidOptions&>(call).references;
  };
  return stage;
}

}  // namespace boxwood
