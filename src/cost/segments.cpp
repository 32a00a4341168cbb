#include "cost/segments.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>
#include <tbb/parallel_reduce.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <functional>

namespace boxwood {
namespace {

constexpr std::size_t chunk = 1 << 12;  // segments that one task looks at

/// Where along a chain the boxes that a segment meets are: they are the largest ones.
class Chain {
 public:
  explicit Chain(std::span<const Side> sides) : sides_(sides) {
    if (sides.empty()) return;
    const Box &first = sides.front().box, &last = sides.back().box;
    ascending_ = first.empty() || (!last.empty() && last.contains(first));
    while (empty_ < sides.size() && at(empty_).empty()) ++empty_;
  }

  std::size_t size() const { return sides_.size(); }
  bool ascending() const { return ascending_; }
  /// The place, by size, of the smallest box that is met; size() when none is.
  std::size_t smallest_met(const Segment& segment) const {
    std::size_t low = empty_, high = sides_.size();
    if (low == high || !segment.meets(at(high - 1))) return high;
    --high;
    while (low < high) {
      const std::size_t middle = (low + high) / 2;
      if (segment.meets(at(middle))) {
        high = middle;
      } else {
        low = middle + 1;
      }
    }
    return low;
  }
  /// The same as a number of `sides`.
  std::size_t side(std::size_t by_size) const { return ascending_ ? by_size : sides_.size() - 1 - by_size; }

 private:
  const Box& at(std::size_t by_size) const { return sides_[side(by_size)].box; }

  std::span<const Side> sides_;
  bool ascending_ = true;
  std::size_t empty_ = 0;
};

using Counts = std::vector<std::uint32_t>;

/// Sums what `add(number of the segment, counts)` counts, over a list. Sums of integers: the same for any threads.
template <class Add>
Counts sum_over(const SegmentList& list, std::size_t size, const Add& add) {
  const auto sum_range = [&](const tbb::blocked_range<std::size_t>& range, Counts counts) {
    for (std::size_t i = range.begin(); i < range.end(); ++i) add(list[i], counts);
    return counts;
  };
  if (list.size() <= 2 * chunk) return sum_range({0, list.size(), chunk}, Counts(size));
  // Isolated, so that waiting does not start another subtree on top of this one's stack.
  return tbb::this_task_arena::isolate([&] {
    return tbb::parallel_reduce(tbb::blocked_range<std::size_t>(0, list.size(), chunk), Counts(size), sum_range,
                                [](Counts a, const Counts& b) {
                                  std::transform(a.begin(), a.end(), b.begin(), a.begin(), std::plus<>());
                                  return a;
                                });
  });
}

}  // namespace

SegmentList segments_that_meet(std::span<const Segment> segments, const SegmentList& list, const Box& box) {
  SegmentList met;
  if (list.size() <= 2 * chunk) {
    for (const std::uint32_t number : list) {
      if (segments[number].meets(box)) met.push_back(number);
    }
    met.shrink_to_fit();
    return met;
  }
  const std::size_t chunks = (list.size() + chunk - 1) / chunk;
  std::vector<SegmentList> parts(chunks);
  tbb::this_task_arena::isolate([&] {
    tbb::parallel_for(std::size_t{0}, chunks, [&](std::size_t c) {
      for (std::size_t i = c * chunk; i < std::min(list.size(), (c + 1) * chunk); ++i) {
        if (segments[list[i]].meets(box)) parts[c].push_back(list[i]);
      }
    });
  });
  std::size_t size = 0;
  for (const SegmentList& part : parts) size += part.size();
  met.reserve(size);
  for (const SegmentList& part : parts) met.insert(met.end(), part.begin(), part.end());
  return met;
}

void count_in_chain(std::span<const Segment> segments, const SegmentList& list, std::span<const Side> sides,
                    std::span<std::uint32_t> counts) {
  const Chain chain(sides);
  const Counts first_met = sum_over(list, sides.size() + 1, [&](std::uint32_t number, Counts& sums) {
    ++sums[chain.smallest_met(segments[number])];
  });
  std::uint32_t met = 0;
  for (std::size_t i = 0; i < sides.size(); ++i) counts[chain.side(i)] = met += first_met[i];
}

void count_in_either(std::span<const Segment> segments, const SegmentList& list, std::span<const Side> left,
                     std::span<const Side> right, std::span<std::uint32_t> counts) {
  const Chain left_chain(left), right_chain(right);
  const std::size_t size = left.size();
  // A segment meets left boxes from `left_from` on and right ones before `right_end`; in between it meets neither.
  const Counts change = sum_over(list, size + 1, [&](std::uint32_t number, Counts& sums) {
    const std::size_t a = left_chain.smallest_met(segments[number]), b = right_chain.smallest_met(segments[number]);
    const std::size_t left_from = a, right_end = size - b;
    if (right_end >= left_from) {
      ++sums[0];
      return;
    }
    if (right_end > 0) ++sums[0], --sums[right_end];
    if (left_from < size) ++sums[left_from];
  });
  std::uint32_t met = 0;
  for (std::size_t i = 0; i < size; ++i) counts[i] = met += change[i];  // wraps around as it should
}

}  // namespace boxwood
