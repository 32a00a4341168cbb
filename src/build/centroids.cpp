#include "build/centroids.h"

#include <tbb/parallel_for.h>

#include <algorithm>

#include "boxwood/error.h"

namespace boxwood {

Centroids::Centroids(const BuildInput& input, CentroidKind kind) {
  if (kind == CentroidKind::box || input.references.empty()) return;
  if (!input.geometry) {
    throw UsageError(
        "centroid=mean needs triangles, but this build has boxes only; use centroid=box, or flatten the scene");
  }
  std::uint32_t last = 0;
  for (const Reference& reference : input.references) last = std::max(last, reference.primitive);
  means_.resize(std::size_t{last} + 1);
  tbb::parallel_for(std::size_t{0}, input.references.size(), [&](std::size_t i) {
    const std::uint32_t primitive = input.references[i].primitive;
    means_[primitive] = input.geometry->centroid(primitive) * 2;
  });
}

}  // namespace boxwood
