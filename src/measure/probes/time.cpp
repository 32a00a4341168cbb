// How long the rays of a set take.
#include "measure/clock.h"
#include "measure/probes/probes.h"
#include "measure/trace_rays.h"

namespace boxwood {
namespace {

std::vector<Value> measure_time(const ProbeInput& input) {
  const Clock clock = input.threads == 1 ? Clock::thread_cpu : Clock::wall;
  Answers answers(*input.rays);
  const double begin = now(clock);
  trace_rays(input.structure, *input.rays, answers);
  return {{"trace_ms", (now(clock) - begin) * 1e3}};
}

}  // namespace

Probe time_probe() {
  return {"time",
          ProbeScope::rays,
          true,
          "how long the rays take",
          {{"trace_ms", "ms", "time to trace all rays of the set: CPU time on one thread, else wall time"}},
          measure_time};
}

}  // namespace boxwood
