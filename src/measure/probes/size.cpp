// How large a structure is.
#include "measure/probes/probes.h"

namespace boxwood {
namespace {

std::vector<Value> measure_size(const ProbeInput& input) {
  const BuildReport& report = input.structure.report();
  std::vector<Value> values = {{"bytes", static_cast<double>(report.bytes)},
                               {"primitives", static_cast<double>(report.primitives)}};
  // A peer's tree cannot be seen.
  if (report.nodes > 0) {
    values.push_back({"nodes", static_cast<double>(report.nodes)});
    values.push_back({"sah_cost", report.sah_cost});
  }
  return values;
}

}  // namespace

Probe size_probe() {
  return {"size",
          ProbeScope::structure,
          false,
          "memory, nodes and surface area cost",
          {{"bytes", "bytes", "memory of the structure, beyond the mesh"},
           {"primitives", "triangles", "usable unique triangles"},
           {"nodes", "nodes", "inner nodes and leaves"},
           {"sah_cost", "", "surface area cost of the tree"}},
          measure_size};
}

}  // namespace boxwood
