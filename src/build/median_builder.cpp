// Object median along the longest side of the node's box, k ways at once. The wide BVH study's `median` is
// median(k=K, centroid=mean): leaves of up to k, cuts at floor(n * i / k).
#include "build/object_median.h"
#include "build/stages.h"

namespace boxwood {

Stage median_stage() {
  return object_median_stage("median", "children of equal count along the longest side of the node's box",
                             "Kay and Kajiya 1986; wide BVH study", {});
}

}  // namespace boxwood
