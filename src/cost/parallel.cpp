// Rays of one direction, the camera's: what a box is worth is its outline along it. Preferred ray sets, parallel:
// Havran and Bittner 1999; SAH alternatives study, section 2.8.
#include <algorithm>
#include <cmath>

#include "cost/models.h"

namespace boxwood {
namespace {

struct ParallelOptions {};

class Parallel final : public CostModel {
 public:
  explicit Parallel(const CostContext& context) {
    for (const Window& window : context.use->windows) directions_.push_back(window.forward);
  }

  void probabilities(const Node& parent, std::span<const Side> sides, std::span<float> out) const override {
    const double whole = outline(parent.box);
    for (std::size_t i = 0; i < sides.size(); ++i) {
      out[i] = whole > 0 ? static_cast<float>(std::min(1.0, outline(sides[i].box) / whole)) : 1;
    }
  }

 private:
  double outline(const Box& box) const {
    if (box.empty()) return 0;
    const Vec3 e = box.extent();
    double area = 0;
    for (const Vec3& d : directions_) {
      area +=
          std::fabs(double{d.x} * e.y * e.z) + std::fabs(double{d.y} * e.x * e.z) + std::fabs(double{d.z} * e.x * e.y);
    }
    return area;
  }

  std::vector<Vec3> directions_;
};

std::unique_ptr<CostModel> make(const ParallelOptions&, const CostContext& context) {
  return std::make_unique<Parallel>(context);
}

}  // namespace

CostModelEntry parallel_entry() {
  return cost_model_entry<ParallelOptions>("parallel", "rays run along the camera's direction",
                                           "Havran and Bittner 1999; SAH alternatives study", {}, true, make);
}

}  // namespace boxwood
