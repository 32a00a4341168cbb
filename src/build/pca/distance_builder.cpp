// Two references far apart attract the others. Sauer 2019 ("Distance"); PCA study, section 2.11, whose method is
// distance(coincident=leaf, order=faithful): it stored the side of its first reference first, as a rule the upper one.
#include <array>

#include "build/builder_options.h"
#include "build/child_order.h"
#include "build/cut_by_count.h"
#include "build/pca/stages.h"
#include "build/reduce.h"

namespace boxwood {
namespace {

struct DistanceOptions {
  CentroidKind centroid = CentroidKind::box;
  Coincident coincident = Coincident::halve;
  StoredOrder order = StoredOrder::corrected;
};

/// The first of the references with the lowest and the highest centroid on each axis: x lowest, x highest, y lowest, …
struct Extremes {
  std::array<Float4, 6> points{};
  bool any = false;

  void add(Float4 point) {
    for (int axis = 0; axis < 3; ++axis) {
      const std::size_t at = 2 * static_cast<std::size_t>(axis);
      Float4 &lowest = points[at], &highest = points[at + 1];
      if (!any || point[axis] < lowest[axis]) lowest = point;
      if (!any || point[axis] > highest[axis]) highest = point;
    }
    any = true;
  }
};

Extremes extremes_of(const ReferenceSet& set, const Centroids& centroids) {
  const auto fold = [&](std::span<const Reference> part, Extremes extremes) {
    for (const Reference& reference : part) extremes.add(centroids(reference));
    return extremes;
  };
  return reduce(std::span<const Reference>(set.references), Extremes{}, fold, [](Extremes a, const Extremes& b) {
    if (b.any) {
      for (const Float4& point : b.points) a.add(point);
    }
    return a;
  });
}

float squared_distance(Float4 a, Float4 b) {
  const Float4 d = a - b;
  return d[0] * d[0] + d[1] * d[1] + d[2] * d[2];
}

Cuts cut_between_two(const ReferenceSet& set, const Centroids& centroids) {
  const Extremes extremes = extremes_of(set, centroids);
  Float4 first = extremes.points[0], second = first;
  float farthest = -1;
  for (const Float4& a : extremes.points) {
    for (const Float4& b : extremes.points) {
      const float distance = squared_distance(a, b);
      if (distance < farthest) continue;  // of equals the last, as in the study's program
      farthest = distance;
      first = a;
      second = b;
    }
  }
  Cuts cuts;
  const int axis = longest_axis(set.centers);
  cuts.axis = static_cast<std::uint32_t>(axis);
  const auto right = std::partition(set.references.begin(), set.references.end(), [&](const Reference& reference) {
    const Float4 point = centroids(reference);
    return squared_distance(point, first) < squared_distance(point, second);
  });
  cuts.add(static_cast<std::uint32_t>(right - set.references.begin()), set.size());
  return cuts.count ? cuts : cut_by_count(set, centroids, axis, 2);
}

Tree build_distance(const DistanceOptions& options, BuildInput input) {
  const Centroids centroids(input, options.centroid);
  const auto split = [&](const ReferenceSet& set) { return cut_between_two(set, centroids); };
  Tree tree = build_top_down(std::move(input), centroids, 1, split, options.coincident);
  if (options.order == StoredOrder::corrected) correct_child_order(tree);
  return tree;
}

}  // namespace

Stage distance_stage() {
  OptionsOf<DistanceOptions> options;
  add_centroid(options);
  add_coincident(options);
  add_stored_order(options);
  return builder_stage<DistanceOptions>("distance", "parts references by which of two, far apart, they are nearer to",
                                        "Sauer 2019 (Distance); PCA study", options, build_distance,
                                        [](const DistanceOptions&) { return 2u; });
}

}  // namespace boxwood
