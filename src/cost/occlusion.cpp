// Occlusion surface area heuristic: parts what rays end on from what they never see. Vinkler, Havran, Sochor 2012,
// "Visibility driven BVH build up algorithm for ray tracing"; SAH alternatives study, section 2.10.
#include <algorithm>

#include "cost/models.h"
#include "cost/surface_area.h"

namespace boxwood {
namespace {

struct OcclusionOptions {
  float weight = 0.9f;
  std::uint32_t depth = 64;
};

struct Level final : CostModel::Memory {
  explicit Level(std::uint32_t at) : level(at) {}
  std::uint32_t level;
};

class Occlusion final : public CostModel {
 public:
  explicit Occlusion(const OcclusionOptions& options) : options_(options) {}

  void probabilities(const Node& parent, std::span<const Side> sides, std::span<float> out) const override {
    by_area_.probabilities(parent, sides, out);
    if (parent.seen == 0 || parent.seen == parent.count || is_surface_area(parent.memory)) return;
    for (std::size_t i = 0; i < sides.size(); ++i) {
      const float share = static_cast<float>(sides[i].seen) / static_cast<float>(parent.seen);
      out[i] += options_.weight * (share - out[i]);
    }
  }

  std::shared_ptr<const Memory> enter(const Box&, const Memory* parent) const override {
    return std::make_shared<Level>(parent ? static_cast<const Level*>(parent)->level + 1 : 0);
  }
  bool is_surface_area(const Memory* memory) const override {
    return static_cast<const Level*>(memory)->level >= options_.depth;
  }

  bool has_rival() const override { return true; }
  /// What the split hides, its part with the fewest seen, must outnumber each part of the split by area.
  bool accepts(Parts own, Parts by_area) const override {
    const Side& hidden = *std::ranges::min_element(own, {}, &Side::seen);
    return hidden.count > std::ranges::max_element(by_area, {}, &Side::count)->count;
  }

 private:
  OcclusionOptions options_;
  SurfaceArea by_area_;
};

std::unique_ptr<CostModel> make(const OcclusionOptions& options, const CostContext&) {
  return std::make_unique<Occlusion>(options);
}

}  // namespace

CostModelEntry occlusion_entry() {
  OptionsOf<OcclusionOptions> options;
  options.real("weight", &OcclusionOptions::weight, 0, 1, "what the seen primitives say; the rest is surface area")
      .integer("depth", &OcclusionOptions::depth, 0, 1000, "levels from the root; below, surface area decides");
  return cost_model_entry<OcclusionOptions>(
      "osah", "rays go where primitives are seen; parts seen from unseen where that hides enough",
      "Vinkler, Havran, Sochor 2012; SAH alternatives study", options, true, make);
}

}  // namespace boxwood
