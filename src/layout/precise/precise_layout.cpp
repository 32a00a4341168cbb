// Triangles in double precision below single-precision boxes: how trees are laid out, and a layout for meshes in
// single.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "boxwood/error.h"
#include "layout/precise/precise_kernels.h"
#include "layout/precise/precise_level.h"
#include "trace/widened.h"

namespace boxwood {
namespace {

class PreciseLayout final : public Layout {
 public:
  explicit PreciseLayout(PreciseLevel level) : level_(std::move(level)), kernels_(*precise_kernels(level_.k)) {}

  Hit closest_hit(const Ray& ray) const override { return closest(ray, nullptr); }
  bool any_hit(const Ray& ray) const override { return any(ray, nullptr); }
  void closest_hits(std::span<const Ray> rays, std::span<Hit> hits) const override {
    for (std::size_t i = 0; i < rays.size(); ++i) hits[i] = closest(rays[i], nullptr);
  }
  void any_hits(std::span<const Ray> rays, std::span<std::uint8_t> blocked) const override {
    for (std::size_t i = 0; i < rays.size(); ++i) blocked[i] = any(rays[i], nullptr) ? 1 : 0;
  }
  void closest_hits_counted(std::span<const Ray> rays, std::span<Hit> hits,
                            std::span<RayCounters> counters) const override {
    for (std::size_t i = 0; i < rays.size(); ++i) {
      counters[i] = {};
      hits[i] = closest(rays[i], &counters[i]);
    }
  }
  void any_hits_counted(std::span<const Ray> rays, std::span<std::uint8_t> blocked,
                        std::span<RayCounters> counters) const override {
    for (std::size_t i = 0; i < rays.size(); ++i) {
      counters[i] = {};
      blocked[i] = any(rays[i], &counters[i]) ? 1 : 0;
    }
  }
  void offer_hits(const Ray&, Descent, HitSink&) const override {
    throw UsageError(
        "under trace(precision=double) closest and any hits are found only; all hits, the first k hits, filters and "
        "masks need trace(precision=single)");
  }
  std::size_t bytes() const override { return level_.bytes(); }

 private:
  Hit closest(const Ray& ray, RayCounters* counters) const {
    return rounded(kernels_.closest(level_, widened(ray), counters));
  }
  bool any(const Ray& ray, RayCounters* counters) const { return kernels_.any(level_, widened(ray), counters); }

  PreciseLevel level_;
  const PreciseKernels& kernels_;
};

std::uint32_t widest_node(const std::vector<PreciseFrameTree>& trees) {
  std::uint32_t widest = 2;
  for (const PreciseFrameTree& frame : trees) {
    for (const Tree::Node& node : frame.tree.nodes) {
      if (!node.is_leaf()) widest = std::max(widest, node.count);
    }
  }
  return widest;
}

}  // namespace

std::size_t PreciseLevel::bytes() const {
  std::size_t sum = frames.size() * sizeof(PreciseFrame) + entries.size() * sizeof(PreciseTriangle);
  for (const PreciseFrame& frame : frames) sum += frame.nodes.bytes();
  return sum;
}

PreciseLevel encode_precise_level(const std::vector<PreciseFrameTree>& trees, double reach) {
  const std::uint32_t widest = widest_node(trees);
  PreciseLevel level;
  level.k = widest <= 4 ? 4 : widest <= 8 ? 8 : 16;
  level.reach = reach;
  std::size_t references = 0;
  for (const PreciseFrameTree& frame : trees) references += frame.tree.references.size();
  reserve_large(level.entries, references);
  for (const auto& [center, scale, tree, content] : trees) {
    if (tree.empty()) continue;
    PreciseFrame& frame = level.frames.emplace_back();
    frame.center = center;
    frame.scale = scale;
    frame.nodes = encode_wide_nodes(tree, level.k);
    frame.reach = extent_of(TriangleLeaves{}, {}, frame.nodes.root_box, {}).reach;
    frame.first_entry = static_cast<std::uint32_t>(level.entries.size());
    for (const std::uint32_t reference : tree.references) level.entries.push_back(content[reference]);
  }
  return level;
}

std::shared_ptr<const Layout> encode_precise(Tree tree, const Contents& contents) {
  if (!contents.mesh) {
    throw UsageError(
        "trace(precision=double) is for one mesh: instances map rays in single precision; flatten the scene, or leave "
        "the option out");
  }
  const Mesh& mesh = *contents.mesh;
  PreciseFrameTree frame;
  frame.content.resize(mesh.triangles.size());
  for (std::uint32_t i = 0; i < mesh.triangles.size(); ++i) {
    const auto& [a, b, c] = mesh.triangles[i];
    frame.content[i] = {widened(mesh.positions[a]), widened(mesh.positions[b]), widened(mesh.positions[c]), i,
                        no_frame};
  }
  const Box bounds = tree.empty() ? Box{} : tree.nodes[0].bounds;
  const float reach = extent_of(TriangleLeaves{}, {}, bounds, contents).reach;
  frame.tree = std::move(tree);
  std::vector<PreciseFrameTree> frames;
  frames.push_back(std::move(frame));
  return std::make_shared<PreciseLayout>(encode_precise_level(frames, static_cast<double>(reach)));
}

}  // namespace boxwood
