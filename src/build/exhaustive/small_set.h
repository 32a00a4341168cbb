#pragma once
#include <array>
#include <bit>
#include <cstdint>
#include <span>
#include <vector>

#include "boxwood/box.h"
#include "build/build_input.h"

namespace boxwood {

/// Some of at most 64 items: bit i is item i.
using Subset = std::uint64_t;
inline constexpr std::uint32_t largest_small_set = 64;

/// What trees over few items cost: areas are halved and not divided by the root's, one test costs 1.
struct SmallSetCosts {
  double traversal = 1;
  std::uint32_t leaf = 1;   ///< most items in a leaf
  bool force_leaf = false;  ///< as few items as fit a leaf are one; else only where that is cheaper
};

/// Few items with their orders along the three axes: by centre, ties by number. Study of SAH alternatives,
/// section 2.14.
class SmallSet {
 public:
  SmallSet(std::vector<Box> boxes, const SmallSetCosts& costs);
  /// `centers2` are doubled centroids.
  SmallSet(std::span<const Reference> references, const std::vector<std::array<float, 3>>& centers2,
           const SmallSetCosts& costs);

  std::uint32_t size() const { return static_cast<std::uint32_t>(boxes_.size()); }
  Subset all() const { return size() == 64 ? ~Subset{0} : (Subset{1} << size()) - 1; }
  const SmallSetCosts& costs() const { return costs_; }

  Box box_of(Subset subset) const;
  double area_of(Subset subset) const { return double{half_area(box_of(subset))}; }
  bool may_be_leaf(Subset subset) const { return count(subset) <= costs_.leaf; }
  bool must_be_leaf(Subset subset) const { return count(subset) == 1 || (costs_.force_leaf && may_be_leaf(subset)); }
  double leaf_cost(Subset subset) const { return area_of(subset) * count(subset); }
  /// No tree over the subset is cheaper.
  double least_cost(Subset subset) const { return least_cost(subset, area_of(subset)); }

  /// A way to part a subset in two, and a lower bound of what both cost.
  struct Cut {
    Subset left = 0, right = 0;
    double least = 0;
  };
  /// All 3 (n - 1) cuts between items in order, axis by axis.
  std::vector<Cut> cuts(Subset subset) const;

  static std::uint32_t count(Subset subset) { return static_cast<std::uint32_t>(std::popcount(subset)); }

 private:
  void sort();
  double least_cost(Subset subset, double area) const;

  std::vector<Box> boxes_;
  std::vector<std::array<float, 3>> centers2_;
  std::vector<double> areas_;
  SmallSetCosts costs_;
  std::array<std::vector<std::uint32_t>, 3> orders_;
};

}  // namespace boxwood
