#include "build/spatial/split.h"

#include <algorithm>
#include <array>

namespace boxwood {
namespace {

/// `entries` begin in this bin, `exits` end in it; of whole references both are the same.
struct Bin {
  Box4 box;
  std::uint32_t entries = 0, exits = 0;
  std::uint32_t seen_entries = 0, seen_exits = 0;  // counted for models only
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

/// Both sides of every border of one axis.
struct Sides {
  std::array<Side, max_spatial_bins> left, right;
  std::array<float, max_spatial_bins> left_share, right_share;

  Sides(const AxisBins& bins, std::size_t count) {
    Box4 box;
    Side side;
    for (std::size_t b = count - 1; b > 0; --b) {
      box.grow(bins[b].box);
      side.box = box.box();
      side.count += bins[b].exits;
      side.seen += bins[b].seen_exits;
      right[b] = side;
    }
    box = {};
    side = {};
    for (std::size_t b = 1; b < count; ++b) {
      box.grow(bins[b - 1].box);
      side.box = box.box();
      side.count += bins[b - 1].entries;
      side.seen += bins[b - 1].seen_entries;
      left[b] = side;
    }
  }
};

Box4 box4(const Box& box) {
  Box4 out;
  out.lower = Float4{box.lower.x, box.lower.y, box.lower.z, 0};
  out.upper = Float4{box.upper.x, box.upper.y, box.upper.z, 0};
  return out;
}

/// Like sweep(), by the set's model. Prices are times the node's area, as surface area's are.
void sweep_by_model(const FragmentSet& set, const AxisBins& bins, std::int32_t count, int axis, LeafPrice price,
                    Split& best) {
  const auto size = static_cast<std::size_t>(count);
  const float area = half_area(set.bounds);
  if (size < 2 || !(area > 0)) return;
  Sides sides(bins, size);
  CostModel::Node node{set.bounds.box(), set.size(), 0, set.memory};
  for (const Reference& reference : set.references) node.seen += reference.seen != 0 ? 1 : 0;
  const auto inner = [&](auto& all) { return std::span(all).subspan(1, size - 1); };
  set.model->pair_probabilities(node, inner(sides.left), inner(sides.right), inner(sides.left_share),
                                inner(sides.right_share));
  for (std::size_t b = 1; b < size; ++b) {
    const Side &left = sides.left[b], &right = sides.right[b];
    if (left.count == 0 || right.count == 0) continue;
    const float cost = area * (sides.left_share[b] * price(left.count) + sides.right_share[b] * price(right.count));
    if (!(cost < best.cost)) continue;
    best.cost = cost;
    best.axis = axis;
    best.border = static_cast<std::int32_t>(b);
    best.left = box4(left.box), best.right = box4(right.box);
    best.left_count = left.count, best.right_count = right.count;
    best.left_seen = left.seen, best.right_seen = right.seen;
  }
}

/// The best border of the axes by the set's model, or by surface area where there is none or where the model's choice
/// does not stand up to surface area's.
template <class BinsOf>
void find_best(const FragmentSet& set, int first_axis, int last_axis, std::uint32_t count, const BinsOf& bins_of,
               LeafPrice price, Split& best) {
  const auto borders = static_cast<std::int32_t>(count);
  const Split none = best;
  if (set.model) {
    for (int axis = first_axis; axis <= last_axis; ++axis) {
      sweep_by_model(set, bins_of(axis), borders, axis, price, best);
    }
    if (!best.found() || !set.model->has_rival()) return;
  }
  Split by_area = none;
  for (int axis = first_axis; axis <= last_axis; ++axis) sweep(bins_of(axis), borders, axis, price, by_area);
  if (set.model && by_area.found()) {
    const Side own[2] = {{{}, best.left_count, best.left_seen}, {{}, best.right_count, best.right_seen}};
    const Side rival[2] = {{{}, by_area.left_count, 0}, {{}, by_area.right_count, 0}};
    if (set.model->accepts(own, rival)) return;
  }
  best = by_area;
}

/// Bins filled by the kernel, and how many of their references are seen.
std::array<AxisBins, 3> bins_for_models(const FragmentSet& set, const Slabs& slabs, const BinRows& rows) {
  std::array<AxisBins, 3> axes;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    for (std::size_t b = 0; b < rows.bins; ++b) {
      Bin& bin = axes[axis][b];
      bin = {};
      bin.box = rows.boxes[4 * b + axis].box();
      bin.entries = bin.exits = rows.counts[4 * b + axis];
    }
  }
  for (const Reference& reference : set.references) {
    if (reference.seen == 0) continue;
    const Box4 box = box4(reference);
    const Int4 at = slabs(box.lower + box.upper);
    for (int axis = 0; axis < 3; ++axis) {
      Bin& bin = axes[static_cast<std::size_t>(axis)][static_cast<std::size_t>(at[axis])];
      bin.seen_exits = ++bin.seen_entries;
    }
  }
  return axes;
}

}  // namespace

Slabs::Slabs(const Box4& box, std::uint32_t count) {
  scale_.origin = box.lower;
  const auto bins = static_cast<float>(count);
  const Float4 extent = box.upper - box.lower;
  for (int axis = 0; axis < 3; ++axis) {
    const float scale = bins / extent[axis];
    scale_.scale[axis] = scale < std::numeric_limits<float>::infinity() ? scale : 0;
    width_[axis] = extent[axis] / bins;
    scale_.last[axis] = bins - 1;
  }
}

SlabAxis Slabs::along(int axis, std::uint32_t count) const {
  SlabAxis out;
  out.axis = axis;
  out.slabs = count;
  out.origin = scale_.origin[axis];
  out.scale = scale_.scale[axis];
  out.last = scale_.last[axis];
  for (std::uint32_t s = 0; s <= count; ++s) out.borders[s] = border(static_cast<std::int32_t>(s), axis);
  return out;
}

Split find_object_split(const FragmentSet& set, std::uint32_t bins, LeafPrice price) {
  Split best;
  best.slabs = Slabs(set.centers, bins);
  GrownBox boxes[4 * max_bins_in_rows];
  std::uint32_t counts[4 * max_bins_in_rows];
  const BinRows rows{boxes, counts, bins};
  fill_bins(set.references, best.slabs.scale(), rows);
  if (set.model) {
    const std::array<AxisBins, 3> axes = bins_for_models(set, best.slabs, rows);
    const auto bins_of = [&](int axis) -> const AxisBins& { return axes[static_cast<std::size_t>(axis)]; };
    find_best(set, 0, 2, bins, bins_of, price, best);
    return best;
  }
  const BinBorder border = cheapest_border(rows, price.shift);
  best.cost = border.cost;
  best.axis = border.axis;
  best.border = border.border;
  best.left = border.left;
  best.right = border.right;
  best.left_count = border.left_count;
  best.right_count = border.right_count;
  return best;
}

Split find_spatial_split(const FragmentSet& set, const Geometry& geometry, std::uint32_t bins, LeafPrice price) {
  Split best;
  best.slabs = Slabs(set.bounds, bins);
  const int axis = longest_axis(set.bounds);
  SlabContents contents;
  fill_slabs(set.references, geometry, best.slabs.along(axis, bins), contents);
  AxisBins row;
  for (std::uint32_t b = 0; b < bins; ++b) row[b] = {contents.boxes[b], contents.begin[b], contents.end[b]};
  if (set.model) {
    for (const Reference& reference : set.references) {
      if (reference.seen == 0) continue;
      const Box4 box = box4(reference);
      ++row[static_cast<std::size_t>(best.slabs(box.lower[axis], axis))].seen_entries;
      ++row[static_cast<std::size_t>(best.slabs(box.upper[axis], axis))].seen_exits;
    }
  }
  find_best(
      set, axis, axis, bins, [&](int) -> const AxisBins& { return row; }, price, best);
  return best;
}

}  // namespace boxwood
