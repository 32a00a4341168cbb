// Single slab hierarchy: one plane per node. Eisemann, Woizischke, Magnor 2008, "Ray Tracing with the Single-Slab
// Hierarchy"; spec 003. And its twin, whole boxes in the same tree, to compare with.
#include "layout/encode_level.h"
#include "layout/slab/split_encode.h"
#include "layout/stages.h"

namespace boxwood {
namespace {

enum class IndexBits { narrow, wide };
enum class PacketSize { one, four, eight, sixteen };

struct SplitOptions {
  IndexBits index = IndexBits::narrow;
  PacketSize packet = PacketSize::one;
};

std::uint32_t rays_of(PacketSize packet) {
  constexpr std::uint32_t rays[] = {1, 4, 8, 16};
  return rays[static_cast<std::size_t>(packet)];
}

template <class Nodes>
struct Choose {
  std::uint32_t packet;

  auto operator()(const Level<Nodes, TriangleLeaves>& level, const TraceOptions& options) const {
    return split_triangle_kernels<Nodes>(options, level.nodes.stack_need <= most_packet_entries ? packet : 1);
  }
  auto operator()(const Level<Nodes, InstanceLeaves>&, const TraceOptions& options) const {
    return split_instance_kernels<Nodes>(options);
  }
};

template <class Nodes>
std::shared_ptr<const Layout> encode_as(const SplitOptions& options, const char* name, Tree tree,
                                        const Contents& contents, const TraceOptions& trace) {
  const auto nodes_of = [&](const Tree& t) { return encode_split_nodes<Nodes>(t, name); };
  return encode_level(std::move(tree), contents, trace, nodes_of, Choose<Nodes>{rays_of(options.packet)});
}

std::shared_ptr<const Layout> encode_slab(const SplitOptions& options, Tree tree, const Contents& contents,
                                          const TraceOptions& trace) {
  return options.index == IndexBits::narrow ? encode_as<SlabNodes32>(options, "slab", std::move(tree), contents, trace)
                                            : encode_as<SlabNodes64>(options, "slab", std::move(tree), contents, trace);
}

std::shared_ptr<const Layout> encode_boxes(const SplitOptions& options, Tree tree, const Contents& contents,
                                           const TraceOptions& trace) {
  return options.index == IndexBits::narrow
             ? encode_as<BoxNodes32>(options, "binary-split", std::move(tree), contents, trace)
             : encode_as<BoxNodes64>(options, "binary-split", std::move(tree), contents, trace);
}

std::uint32_t two_children(const SplitOptions&) { return 2; }

OptionsOf<SplitOptions> described(const char* bytes) {
  return OptionsOf<SplitOptions>()
      .choice("index", &SplitOptions::index, {"32", "64"}, bytes)
      .choice("packet", &SplitOptions::packet, {"1", "4", "8", "16"},
              "rays of a batch that walk together, when their signs and dominant axes agree");
}

}  // namespace

Stage slab_stage() {
  return layout_stage<SplitOptions>("slab", "one plane per node, the side that cuts most from the parent's region",
                                    "Eisemann, Woizischke, Magnor 2008; spec 003",
                                    described("bits of a node's index and flags: nodes of 8 bytes or 12"), encode_slab,
                                    two_children);
}

Stage binary_split_stage() {
  return layout_stage<SplitOptions>("binary-split", "the slab's twin: whole boxes in the same tree and walk",
                                    "spec 003", described("bits of a node's index and flags: nodes of 28 bytes or 32"),
                                    encode_boxes, two_children);
}

}  // namespace boxwood
