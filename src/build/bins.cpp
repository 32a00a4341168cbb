#include "build/bins.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_reduce.h>
#include <tbb/task_arena.h>

#include <algorithm>

namespace boxwood {
namespace {

constexpr std::size_t parallel_size = 1 << 16;  // sets above this many references are binned by several threads

/// Body of a reduction: every task bins its part of the set into bins of its own.
class BinningTask {
 public:
  BinningTask(Bins& bins, std::span<const Reference> references, const Centroids& centroids, const BinMapping& mapping)
      : bins_(&bins), references_(references), centroids_(centroids), mapping_(mapping) {}
  BinningTask(BinningTask& other, tbb::split)
      : own_(std::make_unique<Bins>(other.bins_->first_axis(), other.bins_->last_axis(), other.bins_->size())),
        bins_(own_.get()),
        references_(other.references_),
        centroids_(other.centroids_),
        mapping_(other.mapping_) {}

  void operator()(const tbb::blocked_range<std::size_t>& range) {
    bins_->add(references_.subspan(range.begin(), range.size()), centroids_, mapping_);
  }
  void join(const BinningTask& other) { bins_->add(*other.bins_); }

 private:
  std::unique_ptr<Bins> own_;
  Bins* bins_;
  std::span<const Reference> references_;
  const Centroids& centroids_;
  const BinMapping& mapping_;
};

}  // namespace

Bins::Bins(int first_axis, int last_axis, std::uint32_t bins)
    : first_axis_(first_axis), last_axis_(last_axis), bins_(bins), boxes_(total()), counts_(total()) {
  std::fill_n(boxes_.data(), total(), Box4{});
  std::fill_n(counts_.data(), total(), 0u);
}

void Bins::add(std::span<const Reference> references, const Centroids& centroids, const BinMapping& mapping) {
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
      const Int4 bin = mapping(centroids(reference));
      add_to(static_cast<std::size_t>(bin[0]), box);
      add_to(bins + static_cast<std::size_t>(bin[1]), box);
      add_to(2 * bins + static_cast<std::size_t>(bin[2]), box);
    }
    return;
  }
  for (int axis = first_axis_; axis <= last_axis_; ++axis) {
    for (const Reference& reference : references) {
      const auto bin = static_cast<std::size_t>(mapping(centroids(reference), axis));
      add_to(static_cast<std::size_t>(axis - first_axis_) * bins + bin, box4(reference));
    }
  }
}

void Bins::add(const Bins& other) {
  for (std::size_t i = 0; i < total(); ++i) {
    boxes_[i].grow(other.boxes_[i]);
    counts_[i] += other.counts_[i];
  }
}

void Bins::count_seen(std::span<const Reference> references, const Centroids& centroids, const BinMapping& mapping) {
  seen_.assign(total(), 0);
  for (const Reference& reference : references) {
    if (reference.seen == 0) continue;
    const Int4 bin = mapping(centroids(reference));
    for (int axis = first_axis_; axis <= last_axis_; ++axis) {
      ++seen_[static_cast<std::size_t>(axis - first_axis_) * bins_ + static_cast<std::size_t>(bin[axis])];
    }
  }
}

void fill(Bins& bins, const ReferenceSet& set, const Centroids& centroids, const BinMapping& mapping) {
  if (set.size() < parallel_size) {
    bins.add(set.references, centroids, mapping);
    return;
  }
  BinningTask whole(bins, set.references, centroids, mapping);
  tbb::this_task_arena::isolate([&] {
    tbb::parallel_deterministic_reduce(tbb::blocked_range<std::size_t>(0, set.references.size(), parallel_size / 4),
                                       whole);
  });
}

}  // namespace boxwood
