#include "build/exhaustive/small_set.h"

#include <algorithm>
#include <numeric>

namespace boxwood {

SmallSet::SmallSet(std::vector<Box> boxes, const SmallSetCosts& costs) : boxes_(std::move(boxes)), costs_(costs) {
  for (const Box& box : boxes_) {
    const Vec3 sum = box.lower + box.upper;
    centers2_.push_back({sum.x, sum.y, sum.z});
  }
  sort();
}

SmallSet::SmallSet(std::span<const Reference> references, const std::vector<std::array<float, 3>>& centers2,
                   const SmallSetCosts& costs)
    : centers2_(centers2), costs_(costs) {
  for (const Reference& reference : references) boxes_.push_back(reference.box());
  sort();
}

void SmallSet::sort() {
  for (std::size_t axis = 0; axis < 3; ++axis) {
    orders_[axis].resize(boxes_.size());
    std::iota(orders_[axis].begin(), orders_[axis].end(), 0u);
    std::ranges::stable_sort(orders_[axis], {}, [&](std::uint32_t i) { return centers2_[i][axis]; });
  }
  for (const Box& box : boxes_) areas_.push_back(double{half_area(box)});
}

Box SmallSet::box_of(Subset subset) const {
  Box box;
  for (Subset rest = subset; rest; rest &= rest - 1) box.grow(boxes_[static_cast<std::size_t>(std::countr_zero(rest))]);
  return box;
}

double SmallSet::least_cost(Subset subset, double area) const {
  const std::uint32_t items = count(subset);
  const double as_leaf = area * items;
  if (must_be_leaf(subset)) return as_leaf;
  // An inner node costs its visit, and its leaves at least the items' own areas.
  double below = 0;
  for (Subset rest = subset; rest; rest &= rest - 1) below += areas_[static_cast<std::size_t>(std::countr_zero(rest))];
  const double as_inner = costs_.traversal * area + below;
  return may_be_leaf(subset) ? std::min(as_leaf, as_inner) : as_inner;
}

std::vector<SmallSet::Cut> SmallSet::cuts(Subset subset) const {
  std::vector<Cut> cuts;
  cuts.reserve(3 * (count(subset) - 1));
  std::array<std::uint32_t, largest_small_set> items;
  for (const std::vector<std::uint32_t>& order : orders_) {
    std::size_t size = 0;
    for (const std::uint32_t item : order) {
      if (subset >> item & 1) items[size++] = item;
    }
    const std::size_t first = cuts.size();
    Box box;
    Subset left = 0;
    for (std::size_t i = 0; i + 1 < size; ++i) {
      box.grow(boxes_[items[i]]);
      left |= Subset{1} << items[i];
      cuts.push_back({left, subset & ~left, least_cost(left, double{half_area(box)})});
    }
    box = {};
    for (std::size_t i = size; i-- > 1;) {
      box.grow(boxes_[items[i]]);
      Cut& cut = cuts[first + i - 1];
      cut.least += least_cost(cut.right, double{half_area(box)});
    }
  }
  return cuts;
}

}  // namespace boxwood
