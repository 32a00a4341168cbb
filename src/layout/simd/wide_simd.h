// Wide hierarchies traced with SIMD instructions: the fast path behind wide(4), wide(8) and wide(16).
#pragma once
#include <cstdint>
#include <memory>

#include "layout/layout.h"
#include "layout/trace_options.h"
#include "recipe/stage.h"
#include "tree/tree.h"

namespace boxwood {

/// Whether there are SIMD kernels for triangles in such nodes under such a walk: width 4, 8 or 16, default traversal.
bool simd_wide_has_kernels(std::uint32_t width, const TraceOptions& trace);

/// Whether the SIMD kernels can trace this: width 4, 8 or 16, triangles at the leaves, default traversal, no node of
/// fixed order or more than `width` children, and a tree that is not absurdly deep. O(nodes).
bool simd_wide_supports(std::uint32_t width, const Tree& tree, const Contents& contents, const TraceOptions& trace);

/// Null where simd_wide_supports() does not hold, which is found out on the way. Answers are bit-identical to every
/// other layout's. Counted queries count real children and real triangles, as every layout does; only the root's own
/// box, which other layouts test first, is not tested here. Throws Error when memory runs out.
std::shared_ptr<const Layout> encode_simd_wide(std::uint32_t width, const Tree& tree, const Contents& contents,
                                               const TraceOptions& trace);

}  // namespace boxwood
