// Rays of a camera: what a box is worth is the part of the picture that it covers. Preferred ray sets, perspective:
// Havran and Bittner 1999; SAH alternatives study, section 2.8.
#include <algorithm>

#include "cost/models.h"
#include "cost/picture.h"
#include "cost/surface_area.h"

namespace boxwood {
namespace {

struct PerspectiveOptions {
  bool literal = false;
};

/// In a node that no camera sees, and below it, surface area counts.
struct OutOfSight final : CostModel::Memory {};

class Perspective final : public CostModel {
 public:
  Perspective(const PerspectiveOptions& options, const CostContext& context) : literal_(options.literal) {
    for (const Window& window : context.use->windows) pictures_.emplace_back(window);
  }

  void probabilities(const Node& parent, std::span<const Side> sides, std::span<float> out) const override {
    if (is_surface_area(parent.memory)) return by_area_.probabilities(parent, sides, out);
    const double whole = covered(parent.box);
    for (std::size_t i = 0; i < sides.size(); ++i) {
      out[i] = whole > 0 ? static_cast<float>(std::min(1.0, covered(sides[i].box) / whole)) : 1;
    }
  }

  std::shared_ptr<const Memory> enter(const Box& node, const Memory* parent) const override {
    if (literal_ || (!parent && covered(node) > 0)) return nullptr;
    return out_of_sight_;
  }
  bool is_surface_area(const Memory* memory) const override { return memory != nullptr; }

 private:
  double covered(const Box& box) const {
    double area = 0;
    for (const Picture& picture : pictures_) {
      area += literal_ ? picture.area_of_projected_corners(box) : picture.area_covered(box);
    }
    return area;
  }

  bool literal_;
  std::vector<Picture> pictures_;
  SurfaceArea by_area_;
  std::shared_ptr<const Memory> out_of_sight_ = std::make_shared<OutOfSight>();
};

std::unique_ptr<CostModel> make(const PerspectiveOptions& options, const CostContext& context) {
  return std::make_unique<Perspective>(options, context);
}

}  // namespace

CostModelEntry perspective_entry() {
  OptionsOf<PerspectiveOptions> options;
  options.flag("literal", &PerspectiveOptions::literal,
               "as the study had it: corners behind the camera are mirrored to its front, and what the camera does not "
               "see is not split");
  return cost_model_entry<PerspectiveOptions>("perspective", "rays leave the camera; area in the picture",
                                              "Havran and Bittner 1999; SAH alternatives study", options, true, make);
}

}  // namespace boxwood
