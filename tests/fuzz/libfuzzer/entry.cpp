// What libFuzzer calls. The environment variable BOXWOOD_FUZZ_TARGET names the target: one program serves all.
#include <cstdio>
#include <cstdlib>

#include "fuzz/targets.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const boxwood::fuzz::Target* const target = [] {
    const char* name = std::getenv("BOXWOOD_FUZZ_TARGET");
    const boxwood::fuzz::Target* found = boxwood::fuzz::find_target(name ? name : "");
    if (found) return found;
    std::fprintf(stderr, "set BOXWOOD_FUZZ_TARGET to one of:");
    for (const boxwood::fuzz::Target& each : boxwood::fuzz::targets()) std::fprintf(stderr, " %s", each.name);
    std::fprintf(stderr, "\n");
    std::exit(2);
  }();
  target->run({data, size});
  return 0;
}
