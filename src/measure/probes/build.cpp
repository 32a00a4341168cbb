// How long building took.
#include "measure/probes/probes.h"

namespace boxwood {
namespace {

std::vector<Value> measure_build(const ProbeInput& input) {
  const double wall_ms = input.structure.report().build_ms;
  return {{"build_ms", input.threads == 1 ? input.build_cpu_ms : wall_ms}, {"build_wall_ms", wall_ms}};
}

}  // namespace

Probe build_probe() {
  return {"build",
          ProbeScope::structure,
          true,
          "how long building takes",
          {{"build_ms", "ms", "time to build: CPU time on one thread, else wall time"},
           {"build_wall_ms", "ms", "wall time to build"}},
          measure_build};
}

}  // namespace boxwood
