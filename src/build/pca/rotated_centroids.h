#pragma once
#include <span>

#include "build/centroids.h"
#include "build/top_down.h"

namespace boxwood {

/// Centroids in the frame of a set's principal axes, about the first of them.
class RotatedCentroids {
 public:
  /// `set` must not be empty. One pass over it; parallel for large ones, with one result for any number of threads.
  RotatedCentroids(const ReferenceSet& set, const Centroids& centroids);

  Float4 operator()(const Reference& reference) const {
    const Float4 d = centroids_(reference) - origin_;
    return x_ * d[0] + y_ * d[1] + z_ * d[2];
  }
  /// The box around them. O(n).
  Box4 range(std::span<const Reference> references) const;

 private:
  const Centroids& centroids_;
  Float4 origin_;
  Float4 x_{}, y_{}, z_{};  ///< what a world axis contributes to each of ours
};

}  // namespace boxwood
