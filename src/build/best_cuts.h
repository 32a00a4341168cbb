// The search for the cheapest cuts through a row of items: bins, or sorted references. Wide BVH study,
// sections 2.6, 2.7.
#pragma once
#include <algorithm>
#include <array>
#include <cstdint>

#include "build/prices.h"
#include "build/top_down.h"

namespace boxwood {

/// A cut before item `at`, and what the two sides cost together.
struct Cut {
  std::uint32_t at = 0;
  float left = 0, right = no_price;
  float price() const { return left + right; }
  bool exists() const { return price() < no_price; }
};

/// How many of item i's references are seen; nothing asks but models.
template <class Pricing, class Items>
std::uint32_t seen_of(const Items& items, std::uint32_t i) {
  if constexpr (Pricing::is_model) return items.seen(i);
  return 0;
}

/// The cheapest cut through items [first, last); the first of equals. `Items` has box(i), count(i) and, for models,
/// seen(i). O(last - first).
template <class Items, class Pricing>
Cut best_cut(const Items& items, const Pricing& pricing, std::uint32_t first, std::uint32_t last) {
  Cut best;
  if (last - first < 2) return best;
  const std::uint32_t candidates = last - first - 1;  // candidate c cuts before item first + c + 1
  typename Pricing::Prices left(pricing, candidates), right(pricing, candidates);
  Box4 box;
  std::uint32_t count = 0, seen = 0;
  for (std::uint32_t c = candidates; c-- > 0;) {
    box.grow(items.box(first + c + 1));
    right.add(c, box, count += items.count(first + c + 1), seen += seen_of<Pricing>(items, first + c + 1));
  }
  box = {};
  count = seen = 0;
  for (std::uint32_t c = 0; c < candidates; ++c) {
    box.grow(items.box(first + c));
    left.add(c, box, count += items.count(first + c), seen += seen_of<Pricing>(items, first + c));
  }
  Pricing::Prices::finish(left, right);
  for (std::uint32_t c = 0; c < candidates; ++c) {
    if (left[c] + right[c] < best.price()) best = {first + c + 1, left[c], right[c]};
  }
  return best;
}

/// Item numbers, ascending, before which to cut, and the price of all parts together.
struct BestCuts {
  std::uint32_t count = 0;
  float price = no_price;
  std::array<std::uint32_t, max_children - 1> at;
};

/// Cuts items [0, size) into at most k parts: time and again the dearest part that can be cut, at its cheapest cut.
/// O(size k) at worst.
template <class Items, class Pricing>
BestCuts best_cuts(const Items& items, const Pricing& pricing, std::uint32_t size, std::uint32_t k) {
  struct Part {
    std::uint32_t first, last;
    float price;
    Cut cut;
  };
  BestCuts cuts;
  const Cut whole = best_cut(items, pricing, 0, size);
  if (!whole.exists()) return cuts;
  cuts.at[cuts.count++] = whole.at;
  cuts.price = whole.price();
  if (k == 2) return cuts;

  std::array<Part, max_children> parts;
  std::uint32_t part_count = 0;
  const auto add_part = [&](std::uint32_t first, std::uint32_t last, float price) {
    parts[part_count++] = {first, last, price, best_cut(items, pricing, first, last)};
  };
  add_part(0, whole.at, whole.left);
  add_part(whole.at, size, whole.right);
  while (part_count < k) {
    // The first of the dearest parts that have a cut.
    std::uint32_t dearest = part_count;
    for (std::uint32_t i = 0; i < part_count; ++i) {
      if (parts[i].cut.exists() && (dearest == part_count || parts[i].price > parts[dearest].price)) dearest = i;
    }
    if (dearest == part_count) break;
    const Part part = parts[dearest];
    std::copy(parts.begin() + dearest + 1, parts.begin() + part_count, parts.begin() + dearest);
    --part_count;
    add_part(part.first, part.cut.at, part.cut.left);
    add_part(part.cut.at, part.last, part.cut.right);
    cuts.at[cuts.count++] = part.cut.at;
    cuts.price += part.cut.price() - part.price;
  }
  std::sort(cuts.at.begin(), cuts.at.begin() + cuts.count);
  return cuts;
}

}  // namespace boxwood
