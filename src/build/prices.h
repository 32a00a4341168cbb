// What the two sides of a candidate split cost: the probability of entering each, times its references. Two forms with
// one interface, so that the cut search is written once and the surface area heuristic pays for no virtual call.
#pragma once
#include <cstdint>
#include <limits>
#include <span>

#include "build/float4.h"
#include "build/scratch.h"
#include "cost/cost_model.h"

namespace boxwood {

inline constexpr float no_price = std::numeric_limits<float>::infinity();  ///< of a side without references
inline constexpr std::size_t small_set = 64;                               ///< sets up to this size need no heap

/// The surface area heuristic, inlined; the same prices as SurfaceArea gives.
class SurfaceAreaPricing {
 public:
  /// False when every probability is 1, so that no cut is better than another.
  bool begin(const Box4& parent) {
    const float area = half_area(parent);
    inverse_ = 1 / area;
    return area > 0 && inverse_ < no_price;
  }

  /// Prices of sides 0 … size - 1 of the parent, filled in any order.
  class Prices {
   public:
    Prices(const SurfaceAreaPricing& pricing, std::size_t size) : inverse_(pricing.inverse_), prices_(size) {}
    void add(std::size_t i, const Box4& box, std::uint32_t count) {
      prices_[i] = count ? half_area(box) * static_cast<float>(count) * inverse_ : no_price;
    }
    void finish() {}
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
  explicit ModelPricing(const CostModel& model) : model_(model) {}

  bool begin(const Box4& parent) {
    parent_ = parent.box();
    return half_area(parent_) > 0;
  }

  class Prices {
   public:
    Prices(const ModelPricing& pricing, std::size_t size)
        : pricing_(pricing), size_(size), sides_(size), prices_(size) {}
    void add(std::size_t i, const Box4& box, std::uint32_t count) { sides_[i] = {box.box(), count}; }
    void finish() {
      pricing_.model_.probabilities(pricing_.parent_, {sides_.data(), size_}, {prices_.data(), size_});
      for (std::size_t i = 0; i < size_; ++i) {
        prices_[i] = sides_[i].count ? prices_[i] * static_cast<float>(sides_[i].count) : no_price;
      }
    }
    float operator[](std::size_t i) const { return prices_[i]; }

   private:
    const ModelPricing& pricing_;
    std::size_t size_;
    Scratch<Side, small_set> sides_;
    Scratch<float, small_set> prices_;
  };

 private:
  const CostModel& model_;
  Box parent_;
};

}  // namespace boxwood
