#pragma once
#include "build/top_down.h"

namespace boxwood {

/// Cuts a set of n references into k parts of equal count along `axis`: cut i is floor(n * i / k). Ties between
/// centroids go by primitive number, so what is in a part depends on nothing else. O(n k).
Cuts cut_by_count(const ReferenceSet& set, const Centroids& centroids, int axis, std::uint32_t k);

}  // namespace boxwood
