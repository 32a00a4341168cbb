#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include "boxwood/scene.h"
#include "cost/known_use.h"
#include "tree/end_point_overlap.h"
#include "tree/ray_cost.h"

namespace boxwood {

/// How good a tree is thought to be, beyond its surface area cost.
struct TreeMetrics {
  EndPointOverlap overlap;
  RayCost lines;  ///< uniform lines through the tree's box: what the surface area model takes rays to be
  struct OfKind {
    std::string kind;
    RayCost cost;
  };
  std::vector<OfKind> rays;  ///< rays that are expected, kind by kind, up to where they end
  RayCost all_rays;          ///< all of them together
};

/// `samples`: as end_point_overlap() takes them. Parallel.
TreeMetrics tree_metrics(const Tree& tree, const Mesh& mesh, const KnownUse& use, std::uint32_t samples);

}  // namespace boxwood
