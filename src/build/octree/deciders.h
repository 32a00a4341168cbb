#pragma once
#include <cstdint>
#include <span>

#include "build/octree/octants.h"

namespace boxwood {

/// What decides that a cell becomes a leaf, beside its number of primitives and its level.
enum class OctreeDecider {
  multiplication,  ///< its octants would hold too many references in all
  depth,           ///< nothing: only the level does
  cluster,         ///< the primitives that most octants share fill most of it
  sah              ///< the surface area heuristic, over the whole subtree
};

struct OctreeOptions {
  std::uint32_t primitives = 20;
  float multiplication = 2;
  OctreeDecider decider = OctreeDecider::multiplication;
  std::uint32_t depth = octree_levels;
  float share = 0.8f;
  float volume = 0.5f;
  float traversal_cost = 4;
  bool exact = true;
  float budget = 64;
};

/// A cell with what it would be divided into.
struct OctreeSplit {
  std::span<const std::uint32_t> set;  ///< places in the builder's references
  Octants octants;
  Box box;  ///< of the cell

  double count() const { return static_cast<double>(set.size()); }
  /// References below for each one here, 1 … 8.
  double multiplication() const { return static_cast<double>(octants.total()) / count(); }
};

/// Cost of dividing a cell once, and of not doing so, in primitive tests. Every octant of a box has a quarter of its
/// surface area, so a ray that enters the cell enters a given octant with probability 1/4.
inline constexpr double octant_probability = 0.25;

inline double cost_of_leaf(const OctreeSplit& split) { return split.count(); }
inline double cost_of_split(const OctreeSplit& split, const OctreeOptions& options) {
  return double{options.traversal_cost} + octant_probability * static_cast<double>(split.octants.total());
}

/// Whether the primitives that lie in all of the fullest octants (those with `share` of the cell's references or more)
/// fill more than `volume` of the cell. Spec 004, section 2.2.4.
bool is_cluster(const OctreeSplit& split, std::span<const Reference> references, const OctreeOptions& options);

}  // namespace boxwood
