// What the rays of a set cost in tests, summed over all of them.
#include "measure/probes/probes.h"
#include "measure/trace_rays.h"

namespace boxwood {
namespace {

std::vector<Value> measure_tests(const ProbeInput& input) {
  const CounterTotals totals = count_tests(input.structure, *input.rays);
  return {{"node_tests", static_cast<double>(totals.node_tests)},
          {"node_hits", static_cast<double>(totals.node_hits)},
          {"node_misses", static_cast<double>(totals.node_tests - totals.node_hits)},
          {"primitive_tests", static_cast<double>(totals.primitive_tests)},
          {"steps", static_cast<double>(totals.steps)},
          {"leaf_visits", static_cast<double>(totals.leaves)}};
}

}  // namespace

Probe tests_probe() {
  return {"tests",
          ProbeScope::rays,
          false,
          "tests and steps of all rays of a set together",
          {{"node_tests", "tests", "boxes or planes tested"},
           {"node_hits", "tests", "of those, met by the ray"},
           {"node_misses", "tests", "of those, missed"},
           {"primitive_tests", "tests", "triangles tested"},
           {"steps", "nodes", "inner nodes visited"},
           {"leaf_visits", "leaves", "leaves visited"}},
          measure_tests};
}

}  // namespace boxwood
