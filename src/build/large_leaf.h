#pragma once
#include <cstddef>
#include <limits>

namespace boxwood {

/// Which leaves are better in two though one costs as much to test as each half. A leaf of one block is never cheaper
/// divided on its own, but a wide node has room for both halves, and rays then enter less area. Looked for only in
/// leaves that are large in their scene: these are few, and most of the rays that come to leaves come to them.
struct LargeLeaf {
  /// Halves with less than this part of the area of the whole are better.
  static constexpr float most_in_halves = 0.9f;

  float least_area = std::numeric_limits<float>::infinity();  ///< half area from which a leaf is large

  LargeLeaf() = default;
  /// Of a scene whose box has half this area: `times` what it has for each reference.
  LargeLeaf(float scene_area, std::size_t references, float times)
      : least_area(times * scene_area / static_cast<float>(references)) {}

  bool is_large(float area) const { return area >= least_area; }
  bool is_better_in_halves(float area, float area_of_halves) const {
    return is_large(area) && area_of_halves < most_in_halves * area;
  }
};

}  // namespace boxwood
