// Ray distribution heuristic: the share of representative rays that enter a child. Bittner and Havran 2009, "RDH: Ray
// Distribution Heuristics for Construction of Spatial Data Structures"; SAH alternatives study, section 2.9.
#include "cost/models.h"
#include "cost/segments.h"
#include "cost/surface_area.h"

namespace boxwood {
namespace {

enum class Weighed { all, closest, any, primary, diffuse, shadow, ao };
enum class Among { parent, children };

struct RayDistributionOptions {
  float alpha = 0.9f;
  float beta = 0.1f;
  Weighed rays = Weighed::all;
  bool segments = true;
  Among among = Among::parent;
};

bool is_wanted(const ExpectedRays& rays, Weighed weighed) {
  switch (weighed) {
    case Weighed::all:
      return true;
    case Weighed::closest:
      return rays.query == Query::closest_hit;
    case Weighed::any:
      return rays.query == Query::any_hit;
    case Weighed::primary:
      return rays.kind == "primary";
    case Weighed::diffuse:
      return rays.kind.starts_with("diffuse");
    case Weighed::shadow:
      return rays.kind == "shadow";
    case Weighed::ao:
      return rays.kind == "ao";
  }
  return false;
}

/// The rays that enter a node.
struct EnteringRays final : CostModel::Memory {
  SegmentList list;
};

class RayDistribution final : public CostModel {
 public:
  RayDistribution(const RayDistributionOptions& options, const KnownUse& use) : options_(options) {
    for (const ExpectedRays& rays : use.rays) {
      if (!is_wanted(rays, options.rays)) continue;
      for (std::size_t i = 0; i < rays.rays.size(); ++i) {
        segments_.emplace_back(rays.rays[i], options.segments ? rays.ends[i] : rays.rays[i].t_far);
      }
    }
  }

  std::shared_ptr<const Memory> enter(const Box& node, const Memory* parent) const override {
    if (parent && rays_of(parent).empty()) return none_;
    SegmentList all;
    if (!parent) {
      all.resize(segments_.size());
      for (std::uint32_t i = 0; i < all.size(); ++i) all[i] = i;
    }
    auto memory = std::make_shared<EnteringRays>();
    memory->list = segments_that_meet(segments_, parent ? rays_of(parent) : all, node);
    return memory->list.empty() ? none_ : memory;
  }
  bool is_surface_area(const Memory* memory) const override { return rays_of(memory).empty(); }

  void probabilities(const Node& parent, std::span<const Side> sides, std::span<float> out) const override {
    by_area_.probabilities(parent, sides, out);
    std::vector<std::uint32_t> counts(sides.size());
    count_in_chain(segments_, rays_of(parent.memory), sides, counts);
    const auto entering = static_cast<float>(rays_of(parent.memory).size());
    for (std::size_t i = 0; i < sides.size(); ++i) mix(entering, static_cast<float>(counts[i]), entering, out[i]);
  }

  void pair_probabilities(const Node& parent, std::span<const Side> left, std::span<const Side> right,
                          std::span<float> left_out, std::span<float> right_out) const override {
    if (options_.among == Among::parent) {
      CostModel::pair_probabilities(parent, left, right, left_out, right_out);
      return;
    }
    const SegmentList& list = rays_of(parent.memory);
    by_area_.probabilities(parent, left, left_out);
    by_area_.probabilities(parent, right, right_out);
    std::vector<std::uint32_t> left_counts(left.size()), right_counts(left.size()), either(left.size());
    count_in_chain(segments_, list, left, left_counts);
    count_in_chain(segments_, list, right, right_counts);
    count_in_either(segments_, list, left, right, either);
    const auto entering = static_cast<float>(list.size());
    for (std::size_t i = 0; i < left.size(); ++i) {
      mix(entering, static_cast<float>(left_counts[i]), static_cast<float>(either[i]), left_out[i]);
      mix(entering, static_cast<float>(right_counts[i]), static_cast<float>(either[i]), right_out[i]);
    }
  }

 private:
  static const SegmentList& rays_of(const Memory* memory) { return static_cast<const EnteringRays*>(memory)->list; }

  /// Turns the share of the area in `p` into the blend. Few rays say little: 10 have half the say of all there could
  /// be.
  void mix(float entering, float met, float of, float& p) const {
    if (of == 0) return;
    const float weight = options_.alpha * (1 - 1 / (1 + options_.beta * entering));
    p += weight * (met / of - p);
  }

  RayDistributionOptions options_;
  std::vector<Segment> segments_;
  SurfaceArea by_area_;
  std::shared_ptr<const EnteringRays> none_ = std::make_shared<EnteringRays>();
};

std::unique_ptr<CostModel> make(const RayDistributionOptions& options, const CostContext& context) {
  return std::make_unique<RayDistribution>(options, *context.use);
}

}  // namespace

CostModelEntry ray_distribution_entry() {
  OptionsOf<RayDistributionOptions> options;
  options.real("alpha", &RayDistributionOptions::alpha, 0, 1, "most that the rays say; the rest is surface area")
      .real("beta", &RayDistributionOptions::beta, 0, 1e6f,
            "how soon they say it: n rays have alpha (1 - 1 / (1 + beta n))")
      .choice("rays", &RayDistributionOptions::rays, {"all", "closest", "any", "primary", "diffuse", "shadow", "ao"},
              "which of the representative rays count")
      .flag("segments", &RayDistributionOptions::segments, "rays end where they hit; else they go on")
      .choice("among", &RayDistributionOptions::among, {"parent", "children"},
              "what a share is taken of: the rays that enter the node, or those that enter a child");
  return cost_model_entry<RayDistributionOptions>(
      "rdh", "representative rays, counted; surface area where there are few",
      "Bittner and Havran 2009; SAH alternatives study", options, true, make);
}

}  // namespace boxwood
