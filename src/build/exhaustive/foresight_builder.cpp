// Top-down building that judges a split by the trees it leads to: the most promising splits are built out greedily for
// a trial. Wodniok and Goesele 2017, "Construction of bounding volume hierarchies with SAH cost approximation on
// temporary subtrees"; SAH alternatives study, section 2.14.
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>

#include "build/binned_cuts.h"
#include "build/exhaustive/stages.h"

namespace boxwood {
namespace {

struct ForesightOptions {
  std::uint32_t tries = 4;
  std::uint32_t bins = 16;
  std::uint32_t leaf = 4;
  float traversal_cost = 1;
};

/// A cut between bins of one axis and what it is thought to cost.
struct Candidate {
  int axis = 0;
  std::int32_t border = 0;
  float price = no_price;
};

/// All cuts between bins, the cheapest by surface area first.
std::vector<Candidate> candidates_of(const ReferenceSet& set, const Centroids& centroids, const BinMapping& mapping,
                                     std::uint32_t bins) {
  Bins filled(0, 2, bins);
  fill(filled, set, centroids, mapping);
  std::vector<Candidate> candidates;
  for (int axis = 0; axis < 3; ++axis) {
    const Bins::Row row = filled.row(axis);
    std::vector<float> right(bins);
    Box4 box;
    std::uint32_t count = 0;
    for (std::uint32_t b = bins; b-- > 1;) {
      box.grow(row.box(b));
      count += row.count(b);
      right[b] = count ? half_area(box) * static_cast<float>(count) : no_price;
    }
    box = {};
    count = 0;
    for (std::uint32_t b = 1; b < bins; ++b) {
      box.grow(row.box(b - 1));
      count += row.count(b - 1);
      if (count == 0 || right[b] == no_price) continue;
      candidates.push_back({axis, static_cast<std::int32_t>(b), half_area(box) * static_cast<float>(count) + right[b]});
    }
  }
  std::ranges::stable_sort(candidates, {}, &Candidate::price);
  return candidates;
}

std::uint32_t divide(std::span<Reference> references, const Centroids& centroids, const BinMapping& mapping,
                     const Candidate& candidate) {
  return partition(references, [&](const Reference& reference) {
    return mapping(centroids(reference), candidate.axis) < candidate.border;
  });
}

class Foresight {
 public:
  Foresight(const ForesightOptions& options, const Centroids& centroids) : options_(options), centroids_(centroids) {}

  Cuts split(const ReferenceSet& set) const {
    Cuts cuts;
    const BinMapping mapping(set.centers, options_.bins);
    std::vector<Candidate> candidates = candidates_of(set, centroids_, mapping, options_.bins);
    if (candidates.empty()) return cuts;
    candidates.resize(std::min<std::size_t>(candidates.size(), options_.tries));
    if (candidates.size() > 1 && set.size() > 2) try_out(set, mapping, candidates);
    const Candidate best = *std::ranges::min_element(candidates, {}, &Candidate::price);
    const float area = half_area(set.bounds);
    const float as_leaf = area * static_cast<float>(set.size());
    if (set.size() <= options_.leaf && options_.traversal_cost * area + best.price >= as_leaf) return cuts;
    cuts.axis = static_cast<std::uint32_t>(best.axis);
    cuts.add(divide(set.references, centroids_, mapping, best), set.size());
    return cuts;
  }

 private:
  /// Replaces prices by what greedy trees over both sides cost.
  void try_out(const ReferenceSet& set, const BinMapping& mapping, std::vector<Candidate>& candidates) const {
    const auto price = [&](std::size_t c) {
      LargeVector<Reference> trial(set.references.begin(), set.references.end());
      const std::span<Reference> all(trial);
      const std::uint32_t left = divide(all, centroids_, mapping, candidates[c]);
      candidates[c].price = greedy_cost(all.first(left), 0) + greedy_cost(all.subspan(left), 0);
    };
    if (set.size() < (1 << 12)) {
      for (std::size_t c = 0; c < candidates.size(); ++c) price(c);
    } else {
      tbb::this_task_arena::isolate([&] { tbb::parallel_for(std::size_t{0}, candidates.size(), price); });
    }
  }

  /// Of the tree that the usual binned builder makes, in area times tests.
  float greedy_cost(std::span<Reference> references, std::uint32_t level) const {
    constexpr std::uint32_t deepest = 64;  // below, what is left counts as a leaf
    Box4 bounds, centers;
    for (const Reference& reference : references) {
      bounds.grow(box4(reference));
      centers.grow(centroids_(reference));
    }
    const float area = half_area(bounds);
    const float as_leaf = area * static_cast<float>(references.size());
    if (references.size() == 1 || level == deepest) return as_leaf;
    const ReferenceSet set{references, bounds, centers};
    const BinMapping mapping(centers, options_.bins);
    const std::vector<Candidate> candidates = candidates_of(set, centroids_, mapping, options_.bins);
    if (candidates.empty()) return as_leaf;
    if (references.size() <= options_.leaf && options_.traversal_cost * area + candidates[0].price >= as_leaf) {
      return as_leaf;
    }
    const std::uint32_t left = divide(references, centroids_, mapping, candidates[0]);
    return options_.traversal_cost * area + greedy_cost(references.first(left), level + 1) +
           greedy_cost(references.subspan(left), level + 1);
  }

  const ForesightOptions& options_;
  const Centroids& centroids_;
};

Tree build_foresight(const ForesightOptions& options, BuildInput input) {
  const Centroids centroids(input, CentroidKind::box);
  const Foresight foresight(options, centroids);
  return build_top_down(std::move(input), centroids, options.leaf,
                        [&](const ReferenceSet& set) { return foresight.split(set); });
}

}  // namespace

Stage foresight_stage() {
  OptionsOf<ForesightOptions> options;
  options.integer("tries", &ForesightOptions::tries, 1, 256, "splits of a node that are built out for a trial")
      .integer("bins", &ForesightOptions::bins, 2, max_bins, "bins per axis")
      .integer("leaf", &ForesightOptions::leaf, 1, largest_leaf, "most references in a leaf")
      .real("traversal_cost", &ForesightOptions::traversal_cost, 0, 1e6f,
            "cost of visiting a node, in primitive tests");
  return builder_stage<ForesightOptions>("foresight", "the split whose greedy subtrees are cheapest",
                                         "Wodniok and Goesele 2017", options, build_foresight,
                                         [](const ForesightOptions&) { return 2u; });
}

}  // namespace boxwood
