#include "layout/stages.h"
#include "layout/trace_options.h"

namespace boxwood {

Stage trace_stage() {
  return describe(
      StageKind::trace, "trace", "how rays walk the layout", "specs 000 and 003",
      OptionsOf<TraceOptions>()
          .choice("order", &TraceOptions::order, {"none", "axis", "near"},
                  "which child first: as stored, by the ray's sign on the split axis, by distance")
          .flag("cull", &TraceOptions::cull, "skip what lies behind the closest hit so far, or outside t_near…t_far")
          .choice("mode", &TraceOptions::mode, {"iterative", "recursive"}, "own stack, or the program's")
          .flag("simd", &TraceOptions::simd,
                "several boxes and triangles per instruction, where the layout has such a kernel")
          .choice("precision", &TraceOptions::precision, {"single", "double"},
                  "of the triangle test; double for wide and compressed of up to 16 children, walked by default"),
      static_cast<std::uint32_t (*)(const TraceOptions&)>(nullptr));
}

}  // namespace boxwood
