// What the two sides of a candidate split cost: the probability of entering each, times its references. Two forms with
// one interface, so that the cut search is written once and the surface area heuristic pays for no virtual call.
#pragma once
#include <cstdint>
#include <limits>
#include <span>

#include "build/scratch.h"
#include "build/top_down.h"
#include "cost/cost_model.h"

namespace boxwood {

inline constexpr float no_price = std::numeric_limits<float>::infinity();  ///< of a side without references
inline constexpr std::size_t small_set = 64;                               ///< sets up to this size need no heap

/// The surface area heuristic, inlined; the same prices as SurfaceArea gives.
class SurfaceAreaPricing {
 public:
  static constexpr bool is_model = false;

  /// False when every probability is 1, so that no cut is better than another.
  bool begin(const ReferenceSet& parent) {
    const float area = half_area(parent.bounds);
    inverse_ = 1 / area;
    return area > 0 && inverse_ < no_price;
  }

  /// Prices of sides 0 … size - 1 of the parent, filled in any order.
  class Prices {
   public:
    Prices(const SurfaceAreaPricing& pricing, std::size_t size) : inverse_(pricing.inverse_), prices_(size) {}
    void add(std::size_t i, const Box4& box, std::uint32_t count, std::uint32_t /*seen*/) {
      prices_[i] = count ? half_area(box) * static_cast<float>(count) * inverse_ : no_price;
    }
    static void finish(Prices& /*left*/, Prices& /*right*/) {}
    float operator[](std::size_t i) const { return prices_[i]; }

   private:
    float inverse_;
    Scratch<float, small_set> prices_;
  };

 private:
  float inverse_ = 1;
};

/// Any cost model, asked for all sides at once.
class ModelPricing {
 public:
  static constexpr bool is_model = true;

  explicit ModelPricing(const CostModel& model) : model_(model) {}
  const CostModel& model() const { return model_; }

  bool begin(const ReferenceSet& parent) {
    parent_ = {parent.bounds.box(), parent.size(), 0, parent.memory};
    for (const Reference& reference : parent.references) parent_.seen += reference.seen != 0 ? 1 : 0;
    return half_area(parent_.box) > 0;
  }

  class Prices {
   public:
    Prices(const ModelPricing& pricing, std::size_t size)
        : pricing_(pricing), size_(size), sides_(size), prices_(size) {}
    void add(std::size_t i, const Box4& box, std::uint32_t count, std::uint32_t seen) {
      sides_[i] = {box.box(), count, seen};
    }
    /// Of sides i that were added to both.
    static void finish(Prices& left, Prices& right) {
      left.pricing_.model_.pair_probabilities(left.pricing_.parent_, left.sides(), right.sides(), left.out(),
                                              right.out());
      left.multiply();
      right.multiply();
    }
    float operator[](std::size_t i) const { return prices_[i]; }

   private:
    std::span<const Side> sides() { return {sides_.data(), size_}; }
    std::span<float> out() { return {prices_.data(), size_}; }
    void multiply() {
      for (std::size_t i = 0; i < size_; ++i) {
        prices_[i] = sides_[i].count ? prices_[i] * static_cast<float>(sides_[i].count) : no_price;
      }
    }

    const ModelPricing& pricing_;
    std::size_t size_;
    Scratch<Side, small_set> sides_;
    Scratch<float, small_set> prices_;
  };

 private:
  const CostModel& model_;
  CostModel::Node parent_;
};

}  // namespace boxwood
