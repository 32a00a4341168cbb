#pragma once
#include <array>

#include "cost/cost_model.h"

namespace boxwood {

/// Rays that start uniformly inside the scene box, in uniform directions. How likely such a ray meets a box has no
/// closed form; the two models below approximate it. Fabianowski, Flanagan, Dingliana 2009, "A Cost Metric for
/// Scene-Interior Ray Origins". All in double.
class SceneInterior : public CostModel {
 public:
  /// `scene` may be flat or empty; it is widened a little.
  explicit SceneInterior(const Box& scene);
  void probabilities(const Node& parent, std::span<const Side> sides, std::span<float> out) const final;

 protected:
  /// An interval per axis.
  struct Range {
    double low = 0, high = 0;
    double size() const { return high - low; }
  };
  using Ranges = std::array<Range, 3>;

  /// Volume from which rays meet `node`, each part weighted by the share of its rays that do. `node` is not empty.
  virtual double reached_volume(const Ranges& node) const = 0;
  const Ranges& scene() const { return scene_; }

 private:
  double reached_volume(const Box& box) const;
  Ranges scene_;
};

/// Each face sees the slab of the scene beyond it, as its share of that slab's surface. The six slabs overlap.
class InteriorFast final : public SceneInterior {
 public:
  using SceneInterior::SceneInterior;

 protected:
  double reached_volume(const Ranges& node) const override;
};

/// The planes of the node's faces cut the scene into 27 cells; from the centre of each, the exact solid angle of the
/// node.
class InteriorHq final : public SceneInterior {
 public:
  using SceneInterior::SceneInterior;

 protected:
  double reached_volume(const Ranges& node) const override;
};

}  // namespace boxwood
