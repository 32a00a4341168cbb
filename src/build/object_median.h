// Object median: every child gets the same number of references. What `median` and `equal` share.
#pragma once
#include "build/builder_options.h"
#include "recipe/stage.h"

namespace boxwood {

struct ObjectMedianOptions {
  std::uint32_t k = 2;
  Extent extent = Extent::box;
  CentroidKind centroid = CentroidKind::box;
  std::uint32_t leaf = 0;
  Coincident coincident = Coincident::halve;
};

/// The stage `name`, with these defaults.
Stage object_median_stage(std::string name, std::string summary, std::string source,
                          const ObjectMedianOptions& defaults);

}  // namespace boxwood
