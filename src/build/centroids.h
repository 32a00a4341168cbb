#pragma once
#include <vector>

#include "build/build_input.h"
#include "build/float4.h"

namespace boxwood {

/// What stands for a primitive when references are ordered: the centre of its box, or its own centre of mass.
enum class CentroidKind { box, mean };

/// Doubled centroids of references. Doubling spares the halving and changes no comparison.
class Centroids {
 public:
  /// Throws UsageError when `kind` is mean and the input has no geometry. Mean: O(n), 12 bytes per primitive.
  Centroids(const BuildInput& input, CentroidKind kind);

  Float4 operator()(const Reference& reference) const {
    if (!means_.empty()) {
      const Vec3& mean = means_[reference.primitive];
      return Float4{mean.x, mean.y, mean.z, 0};
    }
    const Box4 box = box4(reference);
    return box.lower + box.upper;
  }

 private:
  std::vector<Vec3> means_;  ///< by primitive, doubled; empty: box centres
};

}  // namespace boxwood
