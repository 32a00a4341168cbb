#include "build/pca/rotated_centroids.h"

#include "build/reduce.h"
#include "math/principal_axes.h"

namespace boxwood {
namespace {

/// About `origin`, a point of the set: differences are then never larger than the set, so nothing cancels.
Moments moments_of(std::span<const Reference> references, const Centroids& centroids, Float4 origin) {
  const auto fold = [&](std::span<const Reference> part, Moments moments) {
    for (const Reference& reference : part) {
      const Float4 d = centroids(reference) - origin;
      moments.add(d[0], d[1], d[2]);
    }
    return moments;
  };
  return reduce(references, Moments{}, fold, [](Moments a, const Moments& b) {
    a.add(b);
    return a;
  });
}

}  // namespace

RotatedCentroids::RotatedCentroids(const ReferenceSet& set, const Centroids& centroids)
    : centroids_(centroids), origin_(centroids(set.references.front())) {
  const PrincipalAxes axes = principal_axes(moments_of(set.references, centroids, origin_));
  for (int i = 0; i < 3; ++i) {
    x_[i] = static_cast<float>(axes.axis[i][0]);
    y_[i] = static_cast<float>(axes.axis[i][1]);
    z_[i] = static_cast<float>(axes.axis[i][2]);
  }
}

Box4 RotatedCentroids::range(std::span<const Reference> references) const {
  const auto fold = [&](std::span<const Reference> part, Box4 box) {
    for (const Reference& reference : part) box.grow((*this)(reference));
    return box;
  };
  return reduce(references, Box4{}, fold, [](Box4 a, const Box4& b) {
    a.grow(b);
    return a;
  });
}

}  // namespace boxwood
