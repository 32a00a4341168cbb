#pragma once
#include <cstddef>
#include <span>
#include <vector>

#include "boxwood/ray.h"

namespace boxwood {

/// As many hits per ray as there are. Those of ray i are hits[offsets[i]] up to hits[offsets[i + 1]].
struct HitLists {
  std::vector<std::size_t> offsets{0};  ///< one more than there are rays, ascending from 0
  std::vector<Hit> hits;

  std::size_t size() const { return offsets.size() - 1; }
  std::span<const Hit> operator[](std::size_t ray) const {
    return {hits.data() + offsets[ray], offsets[ray + 1] - offsets[ray]};
  }
};

}  // namespace boxwood
