#include "layout/simd/wide_simd.h"

#include <optional>
#include <utility>

#include "layout/simd/simd_layout.h"
#include "layout/simd/tree_pieces.h"
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
  std::optional<WideArena> encoded = encode_wide<N, L>(tree, mesh);
  if (!encoded) return {};
  SavableArena<N, L> arena{std::move(*encoded), static_cast<std::uint32_t>(mesh.triangles.size())};
  return std::make_shared<SimdLayout<SavableArena<N, L>>>(std::move(arena), wide_kernels<N, L>());
}

bool has_kernels(std::uint32_t width, const Contents& contents, const TraceOptions& trace) {
  if (!contents.mesh || !simd_wide_has_kernels(width, trace)) return false;
  return contents.mesh->triangles.size() < more_blocks;
}

}  // namespace

bool simd_wide_has_kernels(std::uint32_t width, const TraceOptions& trace) {
  return (width == 4 || width == 8 || width == 16) && trace == TraceOptions{};
}

bool simd_wide_supports(std::uint32_t width, const Tree& tree, const Contents& contents, const TraceOptions& trace) {
  if (!has_kernels(width, contents, trace)) return false;
  const WalkNeeds needs = needs_of(tree);
  return needs.widest <= width && !needs.fixed_order && needs.stack <= wide_stack_limit;
}

std::shared_ptr<const Layout> encode_simd_wide(std::uint32_t width, const Tree& tree, const Contents& contents,
                                               const TraceOptions& trace) {
  if (!has_kernels(width, contents, trace)) return {};
  if (width == 4) return make<4, 4>(tree, *contents.mesh);
  if (width == 8) return make<8, 4>(tree, *contents.mesh);
  return make<16, 8>(tree, *contents.mesh);
}

}  // namespace boxwood
