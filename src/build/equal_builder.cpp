// Object median along the longest side of the centroids' box, down to one reference per leaf. equal(coincident=leaf) is
// the `equal` method of pbrt and of the PCA study.
#include "build/object_median.h"
#include "build/stages.h"

namespace boxwood {

Stage equal_stage() {
  return object_median_stage("equal", "children of equal count along the longest side of the centroids' box",
                             "Pharr, Jakob, Humphreys 2016 (EqualCounts); PCA study",
                             {.extent = Extent::centroids, .leaf = 1});
}

}  // namespace boxwood
