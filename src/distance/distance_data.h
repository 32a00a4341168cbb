#pragma once
#include <mutex>
#include <vector>

#include "distance/placed_triangle.h"
#include "tree/tree.h"

namespace boxwood {

/// A tree over the placed triangles, in leaf order.
struct DistanceQueries::Data {
  Tree tree;  ///< its references are given up: a leaf's are the triangles from `first` on
  std::vector<PlacedTriangle> triangles;
  /// Finite triangles without area: of no distance of their own, but their edges may close a surface.
  std::vector<PlacedTriangle> degenerate;
  float reach = 0;  ///< largest absolute coordinate
  mutable std::once_flag once;
  mutable std::size_t open_edges = 0;  ///< known after `once`

  std::size_t find_open_edges() const;
};

}  // namespace boxwood
