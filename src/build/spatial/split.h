#pragma once
#include <algorithm>
#include <cstdint>
#include <limits>
#include <span>

#include "build/bin_kernels.h"
#include "build/build_input.h"
#include "build/float4.h"
#include "build/spatial/slab_kernels.h"
#include "cost/cost_model.h"

namespace boxwood {

inline constexpr std::uint32_t max_spatial_bins = max_slabs;

/// References to be divided, with the boxes around them and around their doubled centres.
struct FragmentSet {
  std::span<Reference> references;
  Box4 bounds, centers;
  const CostModel* model = nullptr;           ///< prices sides; null: by surface area, quicker
  const CostModel::Memory* memory = nullptr;  ///< what the model remembers of this set's node

  std::uint32_t size() const { return static_cast<std::uint32_t>(references.size()); }
};

/// What a leaf of some size costs: references are tested in blocks of a power of two at the price of one.
struct LeafPrice {
  std::uint32_t shift = 0;
  float operator()(std::uint32_t references) const {
    return static_cast<float>((references + (1u << shift) - 1) >> shift);
  }
};

/// Equal bins between the bounds of a box, the same for all references of a node.
class Slabs {
 public:
  Slabs() = default;
  Slabs(const Box4& box, std::uint32_t count);

  const BinScale& scale() const { return scale_; }
  Int4 operator()(Float4 point) const {
    const Float4 bin = (point - scale_.origin) * scale_.scale;
    return __builtin_convertvector(max4(min4(bin, scale_.last), Float4{}), Int4);
  }
  std::int32_t operator()(float at, int axis) const {
    const float bin = (at - scale_.origin[axis]) * scale_.scale[axis];
    return static_cast<std::int32_t>(std::max(std::min(bin, scale_.last[axis]), 0.0f));
  }
  SlabAxis along(int axis, std::uint32_t count) const;
  /// Border between the bins index - 1 and index.
  float border(std::int32_t index, int axis) const {
    return scale_.origin[axis] + width_[axis] * static_cast<float>(index);
  }

 private:
  BinScale scale_;
  Float4 width_{};
};

/// Where to divide a set: between the bins border - 1 and border of `axis`. No split: `cost` is infinite.
struct Split {
  float cost = std::numeric_limits<float>::infinity();  ///< area times price, both sides together
  int axis = 0;
  std::int32_t border = 0;
  Box4 left, right;
  std::uint32_t left_count = 0, right_count = 0;
  std::uint32_t left_seen = 0, right_seen = 0;  ///< of those, seen ones; counted for models only
  Slabs slabs;

  bool found() const { return cost < std::numeric_limits<float>::infinity(); }
};

/// The best division of the references by their centres, over `bins` equal bins on each axis. Wald 2007. O(n).
Split find_object_split(const FragmentSet& set, std::uint32_t bins, LeafPrice price);

/// The best division of space: references on both sides of the border are cut in two. Stich, Friedrich and Dietrich
/// 2009, section 3. O(n + clipped bins).
Split find_spatial_split(const FragmentSet& set, const Geometry& geometry, std::uint32_t bins, LeafPrice price);

}  // namespace boxwood
