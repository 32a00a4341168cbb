// Bins along the axes of some frame. `Points` tells where in it a reference lies: Centroids for the world's.
#pragma once
#include <tbb/blocked_range.h>
#include <tbb/parallel_reduce.h>
#include <tbb/task_arena.h>

#include <limits>
#include <memory>
#include <span>
#include <vector>

#include "build/scratch.h"
#include "build/top_down.h"

namespace boxwood {

inline constexpr std::uint32_t max_bins = 256;

/// Which bin a point falls into, per axis: bins of equal width between the lowest and the highest point. An axis along
/// which all points coincide has one bin.
class BinMapping {
 public:
  BinMapping(const Box4& range, std::uint32_t bins) : origin_(range.lower) {
    const Float4 extent = range.upper - range.lower;
    const auto count = static_cast<float>(bins);
    for (int axis = 0; axis < 3; ++axis) {
      const float scale = count / extent[axis];
      scale_[axis] = scale < std::numeric_limits<float>::infinity() ? scale : 0;
      last_[axis] = count - 1;
    }
  }
  Int4 operator()(Float4 center) const {
    return __builtin_convertvector(min4((center - origin_) * scale_, last_), Int4);
  }
  std::int32_t operator()(Float4 center, int axis) const {
    const float bin = (center[axis] - origin_[axis]) * scale_[axis];
    return static_cast<std::int32_t>(bin < last_[axis] ? bin : last_[axis]);
  }

 private:
  Float4 origin_, scale_{}, last_{};
};

/// Counts and boxes of the references in each bin, for the axes [first_axis, last_axis].
class Bins {
 public:
  Bins(int first_axis, int last_axis, std::uint32_t bins);
  /// Also counts which references are seen; for models.
  template <class Points>
  void count_seen(std::span<const Reference> references, const Points& points, const BinMapping& mapping);

  template <class Points>
  void add(std::span<const Reference> references, const Points& points, const BinMapping& mapping);
  void add(const Bins& other);

  int first_axis() const { return first_axis_; }
  int last_axis() const { return last_axis_; }
  std::uint32_t size() const { return bins_; }

  /// Items of best_cuts(): the bins of one axis.
  struct Row {
    const Box4* boxes;
    const std::uint32_t* counts;
    const std::uint32_t* seen_counts;
    const Box4& box(std::uint32_t i) const { return boxes[i]; }
    std::uint32_t count(std::uint32_t i) const { return counts[i]; }
    std::uint32_t seen(std::uint32_t i) const { return seen_counts ? seen_counts[i] : 0; }
  };
  Row row(int axis) const {
    const std::size_t first = static_cast<std::size_t>(axis - first_axis_) * bins_;
    return {&boxes_[first], &counts_[first], seen_.empty() ? nullptr : &seen_[first]};
  }

 private:
  static constexpr std::size_t bins_on_stack = 3 * 32;
  std::size_t total() const { return static_cast<std::size_t>(last_axis_ - first_axis_ + 1) * bins_; }

  int first_axis_, last_axis_;
  std::uint32_t bins_;
  Scratch<Box4, bins_on_stack> boxes_;
  Scratch<std::uint32_t, bins_on_stack> counts_;
  std::vector<std::uint32_t> seen_;
};

template <class Points>
void Bins::add(std::span<const Reference> references, const Points& points, const BinMapping& mapping) {
  Box4* boxes = boxes_.data();
  std::uint32_t* counts = counts_.data();
  const std::size_t bins = bins_;
  const auto add_to = [&](std::size_t place, const Box4& box) {
    boxes[place].grow(box);
    ++counts[place];
  };
  if (first_axis_ == 0 && last_axis_ == 2) {
    for (const Reference& reference : references) {
      const Box4 box = box4(reference);
      const Int4 bin = mapping(points(reference));
      add_to(static_cast<std::size_t>(bin[0]), box);
      add_to(bins + static_cast<std::size_t>(bin[1]), box);
      add_to(2 * bins + static_cast<std::size_t>(bin[2]), box);
    }
    return;
  }
  for (int axis = first_axis_; axis <= last_axis_; ++axis) {
    for (const Reference& reference : references) {
      const auto bin = static_cast<std::size_t>(mapping(points(reference), axis));
      add_to(static_cast<std::size_t>(axis - first_axis_) * bins + bin, box4(reference));
    }
  }
}

template <class Points>
void Bins::count_seen(std::span<const Reference> references, const Points& points, const BinMapping& mapping) {
  seen_.assign(total(), 0);
  for (const Reference& reference : references) {
    if (reference.seen == 0) continue;
    const Int4 bin = mapping(points(reference));
    for (int axis = first_axis_; axis <= last_axis_; ++axis) {
      ++seen_[static_cast<std::size_t>(axis - first_axis_) * bins_ + static_cast<std::size_t>(bin[axis])];
    }
  }
}

/// Body of a reduction: every task bins its part of the set into bins of its own.
template <class Points>
class BinningTask {
 public:
  BinningTask(Bins& bins, std::span<const Reference> references, const Points& points, const BinMapping& mapping)
      : bins_(&bins), references_(references), points_(points), mapping_(mapping) {}
  BinningTask(BinningTask& other, tbb::split)
      : own_(std::make_unique<Bins>(other.bins_->first_axis(), other.bins_->last_axis(), other.bins_->size())),
        bins_(own_.get()),
        references_(other.references_),
        points_(other.points_),
        mapping_(other.mapping_) {}

  void operator()(const tbb::blocked_range<std::size_t>& range) {
    bins_->add(references_.subspan(range.begin(), range.size()), points_, mapping_);
  }
  void join(const BinningTask& other) { bins_->add(*other.bins_); }

 private:
  std::unique_ptr<Bins> own_;
  Bins* bins_;
  std::span<const Reference> references_;
  const Points& points_;
  const BinMapping& mapping_;
};

/// Bins a whole set, on several threads when it is large.
template <class Points>
void fill(Bins& bins, const ReferenceSet& set, const Points& points, const BinMapping& mapping) {
  if (set.size() < parallel_size) {
    bins.add(set.references, points, mapping);
    return;
  }
  BinningTask<Points> whole(bins, set.references, points, mapping);
  tbb::this_task_arena::isolate([&] {
    tbb::parallel_deterministic_reduce(tbb::blocked_range<std::size_t>(0, set.references.size(), parallel_size / 4),
                                       whole);
  });
}

}  // namespace boxwood
