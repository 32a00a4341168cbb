// Primitives of the caller's own kind, in wide nodes.
#include "layout/custom/custom_layout.h"

#include <algorithm>

#include "layout/custom/custom_kernels.h"

namespace boxwood {
namespace {

class CustomLayout final : public Layout {
 public:
  explicit CustomLayout(CustomLevel level) : level_(std::move(level)), kernels_(custom_kernels(level_.nodes.k)) {}

  Hit closest_hit(const Ray& ray) const override {
    Hit best;
    kernels_.closest(level_, ray, 0, best, nullptr);
    return best;
  }
  bool any_hit(const Ray& ray) const override { return kernels_.any(level_, ray, nullptr); }
  void closest_hits(std::span<const Ray> rays, std::span<Hit> hits) const override {
    kernels_.closest_batch(level_, rays, hits);
  }
  void any_hits(std::span<const Ray> rays, std::span<std::uint8_t> blocked) const override {
    kernels_.any_batch(level_, rays, blocked);
  }
  void closest_hits_counted(std::span<const Ray> rays, std::span<Hit> hits,
                            std::span<RayCounters> counters) const override {
    for (std::size_t i = 0; i < rays.size(); ++i) {
      hits[i] = {};
      counters[i] = {};
      kernels_.closest(level_, rays[i], 0, hits[i], &counters[i]);
    }
  }
  void any_hits_counted(std::span<const Ray> rays, std::span<std::uint8_t> blocked,
                        std::span<RayCounters> counters) const override {
    for (std::size_t i = 0; i < rays.size(); ++i) {
      counters[i] = {};
      blocked[i] = kernels_.any(level_, rays[i], &counters[i]) ? 1 : 0;
    }
  }
  void closest_below(const Ray& ray, Descent descent, Hit& best, RayCounters* counters) const override {
    kernels_.closest(level_, ray, descent.first_instance, best, counters);
  }
  bool any_below(const Ray& ray, std::uint32_t, RayCounters* counters) const override {
    return kernels_.any(level_, ray, counters);
  }
  void offer_hits(const Ray& ray, Descent descent, HitSink& sink) const override {
    kernels_.offer(level_, ray, descent.first_instance, sink);
  }
  std::size_t bytes() const override {
    return level_.nodes.bytes() + level_.primitives.size() * sizeof(level_.primitives[0]);
  }
  std::vector<LayoutFact> facts() const override {
    return {{"topology_bytes", static_cast<double>(level_.nodes.bytes())},
            {"leaf_bytes", static_cast<double>(bytes() - level_.nodes.bytes())}};
  }

 private:
  CustomLevel level_;
  CustomKernels kernels_;
};

}  // namespace

std::shared_ptr<const Layout> encode_custom(Tree tree, std::shared_ptr<const CustomPrimitives> owner) {
  std::uint32_t widest = 2;
  for (const Tree::Node& node : tree.nodes) {
    if (!node.is_leaf()) widest = std::max(widest, node.count);
  }
  CustomLevel level;
  level.primitives.assign(tree.references.begin(), tree.references.end());
  level.nodes = encode_wide_nodes(tree, widest <= 4 ? 4 : widest <= 8 ? 8 : 16);
  level.extent = extent_of(TriangleLeaves{}, {}, level.nodes.root_box, {});
  level.owner = std::move(owner);
  return std::make_shared<CustomLayout>(std::move(level));
}

}  // namespace boxwood
