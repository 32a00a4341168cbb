// The surface area heuristic plus a price for what the two sides share: a ray that enters the common part of their
// boxes is taken to test the references of both. Sauer 2019; PCA study, section 2.8.
#include "cost/models.h"
#include "cost/surface_area.h"

namespace boxwood {
namespace {

/// What the common part of boxes that do not overlap counts for.
enum class Disjoint {
  published,  ///< the formula on negative extents: a penalty near by, a reward, even below zero, far away
  nothing     ///< nothing, nor for boxes that only touch
};

struct OverlapOptions {
  float weight = 1;
  Disjoint disjoint = Disjoint::nothing;
};

class Overlap final : public CostModel {
 public:
  explicit Overlap(const OverlapOptions& options) : options_(options) {}

  void probabilities(const Node& parent, std::span<const Side> sides, std::span<float> out) const override {
    SurfaceArea{}.probabilities(parent, sides, out);
  }

  /// Either side is charged for its own references with what both share; together that is what the study charges.
  void pair_probabilities(const Node& parent, std::span<const Side> left, std::span<const Side> right,
                          std::span<float> left_out, std::span<float> right_out) const override {
    probabilities(parent, left, left_out);
    probabilities(parent, right, right_out);
    const float area = half_area(parent.box);
    for (std::size_t i = 0; i < left.size(); ++i) {
      if (left[i].count == 0 || right[i].count == 0 || !(area > 0)) continue;
      const float shared = options_.weight * shared_half_area(left[i].box, right[i].box) / area;
      left_out[i] += shared;
      right_out[i] += shared;
    }
  }

 private:
  float shared_half_area(const Box& left, const Box& right) const {
    const Vec3 e = intersect(left, right).extent();
    if (options_.disjoint == Disjoint::nothing && !(e.x > 0 && e.y > 0 && e.z > 0)) return 0;
    return e.x * e.y + e.y * e.z + e.z * e.x;
  }

  OverlapOptions options_;
};

}  // namespace

CostModelEntry overlap_entry() {
  OptionsOf<OverlapOptions> options;
  options.real("weight", &OverlapOptions::weight, 0, 1000, "of what both sides share; the study's is 1")
      .choice("disjoint", &OverlapOptions::disjoint, {"published", "nothing"},
              "sides that do not overlap: the study's formula on negative extents, or nothing");
  return cost_model_entry<OverlapOptions>(
      "overlap", "surface area, and what both sides share is tested twice", "Sauer 2019 (Comb+M); PCA study",
      std::move(options), false, [](const OverlapOptions& chosen, const CostContext&) -> std::unique_ptr<CostModel> {
        return std::make_unique<Overlap>(chosen);
      });
}

}  // namespace boxwood
