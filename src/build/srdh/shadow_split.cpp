#include "build/srdh/shadow_split.h"

#include <algorithm>

namespace boxwood {
namespace {

/// Both sides of every border of an axis: border i has the bins before i on its left.
struct Borders {
  std::vector<Box> left, right;
  std::vector<float> left_count, right_count;

  Borders(const Bins::Row& row, std::uint32_t bins)
      : left(bins + 1), right(bins + 1), left_count(bins + 1), right_count(bins + 1) {
    for (std::uint32_t b = 0; b < bins; ++b) {
      left[b + 1] = unite(left[b], row.box(b).box());
      left_count[b + 1] = left_count[b] + static_cast<float>(row.count(b));
    }
    for (std::uint32_t b = bins; b-- > 0;) {
      right[b] = unite(right[b + 1], row.box(b).box());
      right_count[b] = right_count[b + 1] + static_cast<float>(row.count(b));
    }
  }
};

/// Counts of rays for every border, collected as the borders at which they begin and end.
class Spans {
 public:
  explicit Spans(std::uint32_t bins) : change_(bins + 2) {}
  /// A ray counts for the borders [first, last].
  void add(std::int32_t first, std::int32_t last) {
    if (first > last) return;
    ++change_[static_cast<std::size_t>(first)];
    --change_[static_cast<std::size_t>(last) + 1];
  }
  void finish() {
    for (std::size_t i = 1; i < change_.size(); ++i) change_[i] += change_[i - 1];
  }
  float operator[](std::size_t border) const { return static_cast<float>(change_[border]); }

 private:
  std::vector<std::int32_t> change_;
};

void find_by_rays(const Borders& borders, int axis, const CentersByPrimitive& centers2, const SegmentHits& lists,
                  const NodeRays& rays, std::uint32_t bins, ShadowSplit& best) {
  const auto last = static_cast<std::int32_t>(bins) - 1;  // borders are 1 … last
  Spans meet_left(bins), meet_right(bins), free_left(bins), free_right(bins);
  for (const NodeRays::Entry& entry : rays.entries) {
    const Segment& ray = lists.rays[entry.ray];
    const auto meets = [&](const std::vector<Box>& boxes, std::int32_t border) {
      const Box& box = boxes[static_cast<std::size_t>(border)];
      return !box.empty() && ray.meets(box);
    };
    std::int32_t left_from = 1, right_to = last;
    while (left_from <= last && !meets(borders.left, left_from)) ++left_from;
    while (right_to >= 1 && !meets(borders.right, right_to)) --right_to;
    std::int32_t first_hit = last + 1, last_hit = -1;
    for (const std::uint32_t primitive : rays.hits_of(entry)) {
      const auto& c = centers2[primitive];
      const std::int32_t bin = best.mapping(Float4{c[0], c[1], c[2], 0}, axis);
      first_hit = std::min(first_hit, bin), last_hit = std::max(last_hit, bin);
    }
    meet_left.add(left_from, last);
    meet_right.add(1, right_to);
    // Not ended on the left: nothing is hit in the bins before the border. Not ended on the right: likewise after it.
    free_right.add(1, std::min(right_to, first_hit));
    free_left.add(std::max({left_from, last_hit + 1, 1}), last);
  }
  for (Spans* spans : {&meet_left, &meet_right, &free_left, &free_right}) spans->finish();
  for (std::int32_t border = 1; border <= last; ++border) {
    const auto b = static_cast<std::size_t>(border);
    const float left = borders.left_count[b], right = borders.right_count[b];
    if (left == 0 || right == 0) continue;
    const float left_first = meet_left[b] * left + free_right[b] * right;
    const float right_first = free_left[b] * left + meet_right[b] * right;
    const float cost = std::min(left_first, right_first);
    if (!(cost < best.cost)) continue;
    best.cost = cost, best.axis = axis, best.border = border, best.right_first = right_first < left_first;
    best.left = borders.left[b], best.right = borders.right[b];
  }
}

void find_by_area(const Borders& borders, int axis, std::uint32_t bins, ShadowSplit& best) {
  for (std::uint32_t b = 1; b < bins; ++b) {
    const float left = borders.left_count[b], right = borders.right_count[b];
    if (left == 0 || right == 0) continue;
    const float cost = half_area(borders.left[b]) * left + half_area(borders.right[b]) * right;
    if (!(cost < best.cost)) continue;
    best.cost = cost, best.axis = axis, best.border = static_cast<std::int32_t>(b);
    best.left = borders.left[b], best.right = borders.right[b];
  }
}

}  // namespace

ShadowSplit find_shadow_split(const ReferenceSet& set, const Centroids& centroids, const CentersByPrimitive& centers2,
                              const SegmentHits& lists, const NodeRays& rays, std::uint32_t bins) {
  ShadowSplit best;
  best.mapping = BinMapping(set.centers, bins);
  Bins filled(0, 2, bins);
  fill(filled, set, centroids, best.mapping);
  for (int axis = 0; axis < 3; ++axis) {
    if (!(set.centers.lower[axis] < set.centers.upper[axis])) continue;
    const Borders borders(filled.row(axis), bins);
    if (rays.entries.empty()) {
      find_by_area(borders, axis, bins, best);
    } else {
      find_by_rays(borders, axis, centers2, lists, rays, bins, best);
    }
  }
  return best;
}

}  // namespace boxwood
