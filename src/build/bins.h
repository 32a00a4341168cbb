#pragma once
#include <limits>
#include <span>
#include <vector>

#include "build/scratch.h"
#include "build/top_down.h"

namespace boxwood {

inline constexpr std::uint32_t max_bins = 256;

/// Which bin a centroid falls into, per axis: bins of equal width between the lowest and the highest centroid. An axis
/// along which all centroids coincide has one bin.
class BinMapping {
 public:
  BinMapping(const Box4& centers, std::uint32_t bins) : origin_(centers.lower) {
    const Float4 extent = centers.upper - centers.lower;
    const auto count = static_cast<float>(bins);
    for (int axis = 0; axis < 3; ++axis) {
      const float scale = count / extent[axis];
      scale_[axis] = scale < std::numeric_limits<float>::infinity() ? scale : 0;
      last_[axis] = count - 1;
    }
  }
  Int4 operator()(Float4 center) const {
    return __builtin_convertvector(min4((center - origin_) * scale_, last_), Int4);
  }
  std::int32_t operator()(Float4 center, int axis) const {
    const float bin = (center[axis] - origin_[axis]) * scale_[axis];
    return static_cast<std::int32_t>(bin < last_[axis] ? bin : last_[axis]);
  }

 private:
  Float4 origin_, scale_{}, last_{};
};

/// Counts and boxes of the references in each bin, for the axes [first_axis, last_axis].
class Bins {
 public:
  Bins(int first_axis, int last_axis, std::uint32_t bins);
  /// Also counts which references are seen; for models.
  void count_seen(std::span<const Reference> references, const Centroids& centroids, const BinMapping& mapping);

  void add(std::span<const Reference> references, const Centroids& centroids, const BinMapping& mapping);
  void add(const Bins& other);

  int first_axis() const { return first_axis_; }
  int last_axis() const { return last_axis_; }
  std::uint32_t size() const { return bins_; }

  /// Items of best_cuts(): the bins of one axis.
  struct Row {
    const Box4* boxes;
    const std::uint32_t* counts;
    const std::uint32_t* seen_counts;
    const Box4& box(std::uint32_t i) const { return boxes[i]; }
    std::uint32_t count(std::uint32_t i) const { return counts[i]; }
    std::uint32_t seen(std::uint32_t i) const { return seen_counts ? seen_counts[i] : 0; }
  };
  Row row(int axis) const {
    const std::size_t first = static_cast<std::size_t>(axis - first_axis_) * bins_;
    return {&boxes_[first], &counts_[first], seen_.empty() ? nullptr : &seen_[first]};
  }

 private:
  static constexpr std::size_t bins_on_stack = 3 * 32;
  std::size_t total() const { return static_cast<std::size_t>(last_axis_ - first_axis_ + 1) * bins_; }

  int first_axis_, last_axis_;
  std::uint32_t bins_;
  Scratch<Box4, bins_on_stack> boxes_;
  Scratch<std::uint32_t, bins_on_stack> counts_;
  std::vector<std::uint32_t> seen_;
};

/// Bins a whole set, on several threads when it is large.
void fill(Bins& bins, const ReferenceSet& set, const Centroids& centroids, const BinMapping& mapping);

}  // namespace boxwood
