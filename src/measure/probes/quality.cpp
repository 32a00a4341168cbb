// How good a tree is thought to be: metrics of the literature beside the surface area cost.
#include "measure/probes/probes.h"
#include "structure/object_use.h"
#include "structure/tree_metrics.h"

namespace boxwood {
namespace {

constexpr std::uint32_t epo_samples = 20000;

/// Of scenes of one tree; others have no single figure.
std::vector<Value> measure_quality(const ProbeInput& input) {
  if (!input.use || !input.scene.single_level() || input.trees().empty()) return {};
  const KnownUse known = use_of_mesh(*input.use, input.scene, 0, {});
  const TreeMetrics metrics = tree_metrics(input.trees().front(), input.scene.meshes.front(), known, epo_samples);
  return {{"epo", metrics.overlap.epo},
          {"epo_error", metrics.overlap.standard_error},
          {"lcv", metrics.all_rays.lcv},
          {"lcv_of_lines", metrics.lines.lcv},
          {"ray_cost", metrics.all_rays.cost}};
}

}  // namespace

Probe quality_probe() {
  return {"quality",
          ProbeScope::structure,
          false,
          "metrics of the tree; of scenes of one mesh placed once",
          {{"epo", "", "end-point overlap"},
           {"epo_error", "", "its standard error, where triangles were sampled"},
           {"lcv", "leaves", "standard deviation of the leaves that a ray of the first view meets"},
           {"lcv_of_lines", "leaves", "the same of uniform lines"},
           {"ray_cost", "", "inner nodes and references that a ray of the first view meets, on average"}},
          measure_quality};
}

}  // namespace boxwood
