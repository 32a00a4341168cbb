// What splitting cost by the PCA study's own count, and which kind of split won where a builder had the choice.
#include "build/pca/split_wins.h"
#include "measure/probes/probes.h"
#include "recipe/stage.h"
#include "structure/mesh_geometry.h"
#include "tree/split_cost.h"

namespace boxwood {
namespace {

/// Of the builder `combined`, over all meshes; without what recipes may know of rays.
void add_wins(const ProbeInput& input, std::vector<Value>& values) {
  const StageCall& builder = input.structure.recipe().stages().front();
  const auto* options = std::any_cast<PcaCostOptions>(&builder.options);
  if (builder.stage->name != "combined" || !options || options->cost.needs_use()) return;
  SplitWins all;
  for (const Mesh& mesh : input.scene.meshes) {
    const MeshGeometry geometry(mesh);
    const SplitWins wins = count_split_wins(*options, {geometry.references(), &geometry, nullptr});
    all.classical += wins.classical;
    all.principal += wins.principal;
  }
  values.push_back({"classical_wins", static_cast<double>(all.classical)});
  values.push_back({"principal_wins", static_cast<double>(all.principal)});
}

std::vector<Value> measure_splits(const ProbeInput& input) {
  if (input.trees().empty()) return {};
  double sum = 0;
  for (const Tree& tree : input.trees()) sum += split_cost_sum(tree);
  std::vector<Value> values = {{"split_cost_sum", sum}};
  add_wins(input, values);
  return values;
}

}  // namespace

Probe splits_probe() {
  return {"splits",
          ProbeScope::structure,
          false,
          "what splits cost, each by itself, and which kind won",
          {{"split_cost_sum", "", "sum over inner nodes of 1 and, per child, references times its part of the area"},
           {"classical_wins", "nodes", "of combined: nodes cut along a world axis, as that was no dearer"},
           {"principal_wins", "nodes", "of combined: nodes cut along a principal axis, as that was cheaper"}},
          measure_splits};
}

}  // namespace boxwood
