#include "build/spatial/split.h"

#include <algorithm>
#include <array>

#include "build/spatial/slab_clip.h"

namespace boxwood {
namespace {

/// `entries` begin in this bin, `exits` end in it; of whole references both are the same.
struct Bin {
  Box4 box;
  std::uint32_t entries = 0, exits = 0;
};

using AxisBins = std::array<Bin, max_spatial_bins>;

/// Sweeps the borders of one axis: what enters left of a border is left of it, what exits right of it is right.
void sweep(const AxisBins& bins, std::int32_t count, int axis, LeafPrice price, Split& best) {
  std::array<float, max_spatial_bins> right_cost;
  std::array<std::uint32_t, max_spatial_bins> right_count;
  Box4 box;
  std::uint32_t references = 0;
  for (std::int32_t b = count - 1; b > 0; --b) {
    const Bin& bin = bins[static_cast<std::size_t>(b)];
    box.grow(bin.box);
    references += bin.exits;
    right_count[static_cast<std::size_t>(b)] = references;
    right_cost[static_cast<std::size_t>(b)] = references ? half_area(box) * price(references) : 0;
  }
  box = {};
  references = 0;
  std::int32_t best_border = 0;
  for (std::int32_t b = 1; b < count; ++b) {
    const Bin& bin = bins[static_cast<std::size_t>(b - 1)];
    box.grow(bin.box);
    references += bin.entries;
    if (references == 0 || right_count[static_cast<std::size_t>(b)] == 0) continue;
    const float cost = half_area(box) * price(references) + right_cost[static_cast<std::size_t>(b)];
    if (cost < best.cost) {
      best.cost = cost;
      best_border = b;
      best.left = box;
      best.left_count = references;
    }
  }
  if (best_border == 0) return;
  best.axis = axis;
  best.border = best_border;
  best.right_count = right_count[static_cast<std::size_t>(best_border)];
  best.right = {};
  for (std::int32_t b = best_border; b < count; ++b) best.right.grow(bins[static_cast<std::size_t>(b)].box);
}

}  // namespace

Slabs::Slabs(const Box4& box, std::uint32_t count) : origin_(box.lower) {
  const auto bins = static_cast<float>(count);
  const Float4 extent = box.upper - box.lower;
  for (int axis = 0; axis < 3; ++axis) {
    const float scale = bins / extent[axis];
    scale_[axis] = scale < std::numeric_limits<float>::infinity() ? scale : 0;
    width_[axis] = extent[axis] / bins;
    last_[axis] = bins - 1;
  }
}

std::int32_t Slabs::operator()(float at, int axis) const {
  const float bin = (at - origin_[axis]) * scale_[axis];
  return static_cast<std::int32_t>(std::max(std::min(bin, last_[axis]), 0.0f));
}

Split find_object_split(const FragmentSet& set, std::uint32_t bins, LeafPrice price) {
  Split best;
  best.slabs = Slabs(set.centers, bins);
  std::array<AxisBins, 3> axes;
  for (AxisBins& axis : axes) std::fill_n(axis.begin(), bins, Bin{});
  for (const Reference& reference : set.references) {
    const Box4 box = box4(reference);
    const Int4 bin = best.slabs(box.lower + box.upper);
    for (int axis = 0; axis < 3; ++axis) {
      Bin& at = axes[static_cast<std::size_t>(axis)][static_cast<std::size_t>(bin[axis])];
      at.box.grow(box);
      ++at.entries;
    }
  }
  for (int axis = 0; axis < 3; ++axis) {
    AxisBins& row = axes[static_cast<std::size_t>(axis)];
    for (std::uint32_t b = 0; b < bins; ++b) row[b].exits = row[b].entries;
    sweep(row, static_cast<std::int32_t>(bins), axis, price, best);
  }
  return best;
}

Split find_spatial_split(const FragmentSet& set, const Geometry& geometry, std::uint32_t bins, LeafPrice price) {
  Split best;
  best.slabs = Slabs(set.bounds, bins);
  const int axis = longest_axis(set.bounds);
  AxisBins row;
  std::fill_n(row.begin(), bins, Bin{});
  SlabClip clip(best.slabs, geometry);
  for (const Reference& reference : set.references) {
    const Box4 box = box4(reference);
    const std::int32_t first = best.slabs(box.lower[axis], axis), last = best.slabs(box.upper[axis], axis);
    ++row[static_cast<std::size_t>(first)].entries;
    ++row[static_cast<std::size_t>(last)].exits;
    if (first == last) {
      row[static_cast<std::size_t>(first)].box.grow(box);
    } else {
      clip.each_slab(reference.primitive, box, axis, first, last,
                     [&](std::int32_t slab, const Box4& part) { row[static_cast<std::size_t>(slab)].box.grow(part); });
    }
  }
  sweep(row, static_cast<std::int32_t>(bins), axis, price, best);
  return best;
}

}  // namespace boxwood
