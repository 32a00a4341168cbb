// What the rays of a set hit: their number, and a fingerprint that tells whether two structures answer alike.
#include <bit>

#include "math/random.h"
#include "measure/fingerprint.h"
#include "measure/probes/probes.h"
#include "measure/trace_rays.h"

namespace boxwood {
namespace {

std::uint64_t fingerprint(const Answers& answers) {
  Fingerprint print;
  for (const Hit& hit : answers.hits) {
    print.add(hit.primitive);
    if (!hit.valid()) continue;
    print.add(hit.instance);
    print.add(std::bit_cast<std::uint32_t>(hit.t));
    print.add(std::bit_cast<std::uint32_t>(hit.u));
    print.add(std::bit_cast<std::uint32_t>(hit.v));
  }
  for (const std::uint8_t blocked : answers.blocked) print.add(blocked != 0);
  return print.value();
}

std::vector<Value> measure_answers(const ProbeInput& input) {
  Answers answers(*input.rays);
  trace_rays(input.structure, *input.rays, answers);
  return {{"rays", static_cast<double>(input.rays->rays.size())},
          {"hits", static_cast<double>(hits_in(answers))},
          {"answers_hash", hash_as_number(fingerprint(answers))}};
}

}  // namespace

Probe answers_probe() {
  return {"answers",
          ProbeScope::rays,
          false,
          "how many rays hit, and a fingerprint of what they hit",
          {{"rays", "rays", "rays in the set"},
           {"hits", "rays", "of those, how many hit something"},
           {"answers_hash", "hash", "the same when every ray is answered alike, to the bit"}},
          measure_answers};
}

}  // namespace boxwood
