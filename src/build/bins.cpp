#include "build/bins.h"

#include <algorithm>

namespace boxwood {

Bins::Bins(int first_axis, int last_axis, std::uint32_t bins)
    : first_axis_(first_axis), last_axis_(last_axis), bins_(bins), boxes_(total()), counts_(total()) {
  std::fill_n(boxes_.data(), total(), Box4{});
  std::fill_n(counts_.data(), total(), 0u);
}

void Bins::add(const Bins& other) {
  for (std::size_t i = 0; i < total(); ++i) {
    boxes_[i].grow(other.boxes_[i]);
    counts_[i] += other.counts_[i];
  }
}

}  // namespace boxwood
