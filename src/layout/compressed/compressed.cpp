// Wide nodes with boxes of 8-bit coordinates, and leaves that hold their own corners, packed, or only name the
// triangles of the caller's mesh. Ylitie, Karras and Laine 2017; leaves after Benthin, Wald, Woop and Afra 2018,
// "Compressed-Leaf Bounding Volume Hierarchies".
#include <fmt/format.h>

#include "layout/compressed/compressed_kernels.h"
#include "layout/compressed/quantized_arena.h"
#include "layout/simd/simd_layout.h"
#include "layout/simd/wide_simd.h"
#include "layout/stages.h"
#include "options/call.h"
#include "tree/any_hit_order.h"

namespace boxwood {
namespace {

struct CompressedOptions {
  std::uint32_t k = 8;
  std::uint32_t bytes = bytes_per_triangle;
};

template <class Node, int N>
std::shared_ptr<const Layout> make(const Tree& tree, const Mesh& mesh, std::size_t bytes) {
  return std::make_shared<SimdLayout<QuantizedArena>>(encode_quantized<Node>(tree, mesh, bytes),
                                                      compressed_kernels<N>());
}

/// What compressed nodes cannot hold: instances, which are few, trees that are too deep or fix the order of children,
/// and walks other than the default one.
std::shared_ptr<const Layout> encode_wide_instead(std::uint32_t k, Tree tree, const Contents& contents,
                                                  const TraceOptions& trace) {
  const Stage wide = wide_stage();
  std::any options = wide.defaults;
  set_option(wide.name, wide.options, options, fmt::format("k={}", k));
  return wide.encode(options, std::move(tree), contents, trace);
}

std::shared_ptr<const Layout> encode(const CompressedOptions& options, Tree tree, const Contents& contents,
                                     const TraceOptions& trace) {
  const std::uint32_t width = options.k <= 8 ? 8 : 16;
  if (!simd_wide_supports(width, tree, contents, trace) || !has_quantized_names(tree, *contents.mesh, options.bytes)) {
    return encode_wide_instead(options.k, std::move(tree), contents, trace);
  }
  if (width == 8 && fits_eight(tree)) return make<QuantizedNode8, 8>(tree, *contents.mesh, options.bytes);
  return make<QuantizedNode16, 16>(tree, *contents.mesh, options.bytes);
}

}  // namespace

Stage compressed_stage() {
  Stage stage = layout_stage<CompressedOptions>(
      "compressed", "wide nodes of 8-bit boxes over the caller's mesh, which must outlive the structure",
      "Ylitie et al. 2017; Benthin et al. 2018",
      OptionsOf<CompressedOptions>()
          .integer("k", &CompressedOptions::k, 2, 16, "most children per node; kept in nodes of 8 or 16")
          .positional()
          .integer("bytes", &CompressedOptions::bytes, 0, 64,
                   "per triangle that leaves may bring it to by holding their own corners; others name triangles"),
      encode, [](const CompressedOptions& options) { return options.k; });
  stage.custom = true;
  stage.arrange = [](const std::any&, const TraceOptions& trace, Tree& tree) {
    if (trace == TraceOptions{}) order_for_any_hits(tree);
  };
  return stage;
}

}  // namespace boxwood
