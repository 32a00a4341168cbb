// What splitting cost by the PCA study's own count.
#include "measure/probes/probes.h"
#include "tree/split_cost.h"

namespace boxwood {
namespace {

std::vector<Value> measure_splits(const ProbeInput& input) {
  if (input.trees().empty()) return {};
  double sum = 0;
  for (const Tree& tree : input.trees()) sum += split_cost_sum(tree);
  return {{"split_cost_sum", sum}};
}

}  // namespace

Probe splits_probe() {
  return {"splits",
          ProbeScope::structure,
          false,
          "what splits cost, each by itself",
          {{"split_cost_sum", "", "sum over inner nodes of 1 and, per child, references times its part of the area"}},
          measure_splits};
}

}  // namespace boxwood
