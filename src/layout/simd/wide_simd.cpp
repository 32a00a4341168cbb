#include "layout/simd/wide_simd.h"

#include <fmt/format.h>

#include <algorithm>
#include <ranges>

#include "boxwood/error.h"
#include "layout/simd/wide_arena.h"
#include "layout/simd/wide_kernels.h"

namespace boxwood {
namespace {

class SimdWide final : public Layout {
 public:
  SimdWide(WideArena arena, const WideKernels& kernels) : arena_(std::move(arena)), kernels_(kernels) {}

  void closest_hits(std::span<const Ray> rays, std::span<Hit> hits) const override {
    kernels_.closest_hits(arena_.view, rays, hits);
  }
  void any_hits(std::span<const Ray> rays, std::span<std::uint8_t> blocked) const override {
    kernels_.any_hits(arena_.view, rays, blocked);
  }
  Hit closest_hit(const Ray& ray) const override { return kernels_.closest_hit(arena_.view, ray); }
  bool any_hit(const Ray& ray) const override { return kernels_.any_hit(arena_.view, ray); }
  void closest_hits_counted(std::span<const Ray> rays, std::span<Hit> hits,
                            std::span<RayCounters> counters) const override {
    for (std::size_t i = 0; i < rays.size(); ++i) {
      counters[i] = {};
      hits[i] = kernels_.closest_hit_counted(arena_.view, rays[i], counters[i]);
    }
  }
  void any_hits_counted(std::span<const Ray> rays, std::span<std::uint8_t> blocked,
                        std::span<RayCounters> counters) const override {
    for (std::size_t i = 0; i < rays.size(); ++i) {
      counters[i] = {};
      blocked[i] = kernels_.any_hit_counted(arena_.view, rays[i], counters[i]) ? 1 : 0;
    }
  }
  std::size_t bytes() const override { return arena_.memory.bytes(); }

 private:
  WideArena arena_;
  WideKernels kernels_;
};

template <int N, int L>
std::shared_ptr<const Layout> make(const Tree& tree, const Mesh& mesh) {
  return std::make_shared<SimdWide>(encode_wide<N, L>(tree, mesh), wide_kernels<N, L>());
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
