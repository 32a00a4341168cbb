// Options that several top-down builders have, each described once.
#pragma once
#include <cstdint>

#include "build/centroids.h"
#include "build/top_down.h"
#include "options/options.h"

namespace boxwood {

enum class AxisChoice { longest, all };
/// What "longest" is measured on: the box around the centroids, or the node's own box.
enum class Extent { centroids, box };
/// When a small set becomes a leaf: always, or when that costs no more than the best split.
enum class Stop { count, cost };

inline constexpr std::uint32_t largest_leaf = 1 << 20;

inline int longest_axis(const ReferenceSet& set, Extent extent) {
  return longest_axis(extent == Extent::box ? set.bounds : set.centers);
}

// The casts let a struct inherit the member.

template <class T>
void add_arity(OptionsOf<T>& options) {
  options.integer("k", static_cast<std::uint32_t T::*>(&T::k), 2, max_children, "children per node");
}

template <class T>
void add_extent(OptionsOf<T>& options) {
  options.choice("extent", static_cast<Extent T::*>(&T::extent), {"centroids", "box"},
                 "what the longest axis is measured on: the centroids' box or the node's");
}

template <class T>
void add_coincident(OptionsOf<T>& options) {
  options.choice(
      "coincident", static_cast<Coincident T::*>(&T::coincident), {"halve", "leaf"},
      "references with one centroid that are too many for a leaf: halved by count, or one leaf all the same");
}

template <class T>
void add_centroid(OptionsOf<T>& options) {
  options.choice("centroid", static_cast<CentroidKind T::*>(&T::centroid), {"box", "mean"},
                 "what references are ordered by: the centre of their box or their own centre of mass");
}

}  // namespace boxwood
