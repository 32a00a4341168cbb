#include "layout/simd/wide_simd.h"

#include <fmt/format.h>

#include <algorithm>
#include <ranges>

#include "boxwood/error.h"
#include "layout/simd/simd_layout.h"
#include "layout/simd/wide_arena.h"
#include "layout/simd/wide_kernels.h"

namespace boxwood {
namespace {

template <int N, int L>
std::shared_ptr<const Layout> make(const Tree& tree, const Mesh& mesh) {
  return std::make_shared<SimdLayout<WideArena>>(encode_wide<N, L>(tree, mesh), wide_kernels<N, L>());
}

}  // namespace

bool simd_wide_supports(std::uint32_t width, const Tree& tree, const Contents& contents, const TraceOptions& trace) {
  if (width != 4 && width != 8 && width != 16) return false;
  if (!contents.mesh || trace != TraceOptions{}) return false;
  if (contents.mesh->triangles.size() >= more_blocks) return false;
  const bool nodes_fit = std::ranges::all_of(tree.nodes, [&](const Tree::Node& node) {
    return node.is_leaf() || (node.count <= width && node.fixed_order == 0);
  });
  return nodes_fit && stack_need(tree) <= wide_stack_limit;
}

std::shared_ptr<const Layout> encode_simd_wide(std::uint32_t width, const Tree& tree, const Contents& contents) {
  if (!simd_wide_supports(width, tree, contents, TraceOptions{})) {
    throw UsageError(
        fmt::format("the SIMD kernels cannot trace this tree at width {}; use the scalar wide layout, which "
                    "takes any width, depth, order and contents",
                    width));
  }
  if (width == 4) return make<4, 4>(tree, *contents.mesh);
  if (width == 8) return make<8, 4>(tree, *contents.mesh);
  return make<16, 8>(tree, *contents.mesh);
}

}  // namespace boxwood
