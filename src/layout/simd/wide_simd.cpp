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

/// An arena that knows what files must know of it.
template <int N, int L>
struct SavableArena : WideArena {
  std::uint32_t triangles = 0;  ///< of the mesh

  void refit(const Tree& tree, const Mesh& mesh) { refit_wide<N, L>(*this, tree, mesh); }
  void save(SavedLevel& out) const {
    out.facts.kind = SavedKind::simd_wide;
    out.facts.children = N;
    out.facts.block = L;
    out.facts.out_of_cache = view.out_of_cache ? 1 : 0;
    out.facts.stack = view.stack;
    out.facts.root_reference = view.root;
    out.facts.reach = view.reach;
    out.facts.primitives = triangles;
    out.facts.nodes = shape.nodes;
    out.facts.inner_children = shape.children;
    out.facts.triangles = shape.triangles;
    out.nodes = {memory.data(), memory.bytes()};
  }
};

template <int N, int L>
std::shared_ptr<const Layout> make(const Tree& tree, const Mesh& mesh) {
  SavableArena<N, L> arena{encode_wide<N, L>(tree, mesh), static_cast<std::uint32_t>(mesh.triangles.size())};
  return std::make_shared<SimdLayout<SavableArena<N, L>>>(std::move(arena), wide_kernels<N, L>());
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
