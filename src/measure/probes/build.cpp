// How long building took, as the build itself reports it.
#include "measure/probes/probes.h"

namespace boxwood {
namespace {

std::vector<Value> measure(const ProbeInput& input) {
  const BuildReport& report = input.structure.report();
  return {{"build_ms", input.threads == 1 ? report.build_cpu_ms : report.build_ms}, {"build_wall_ms", report.build_ms}};
}

}  // namespace

Probe build_probe() {
  return {"build",
          ProbeScope::structure,
          true,
          "how long building takes",
          {{"build_ms", "ms", "time to build: CPU time on one thread, else wall time"},
           {"build_wall_ms", "ms", "wall time to build"}},
          measure};
}

}  // namespace boxwood
