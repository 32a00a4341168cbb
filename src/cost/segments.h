#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include "cost/cost_model.h"
#include "math/segment.h"

namespace boxwood {

/// Of one node: the numbers of the segments that enter it.
using SegmentList = std::vector<std::uint32_t>;

/// Those of `list` that meet `box`, in order. On several threads when there are many.
SegmentList segments_that_meet(std::span<const Segment> segments, const SegmentList& list, const Box& box);

/// counts[i] = how many of `list` meet sides[i].box. The boxes form a chain (cost_model.h), so each segment needs only
/// O(log sides) tests. On several threads when there are many.
void count_in_chain(std::span<const Segment> segments, const SegmentList& list, std::span<const Side> sides,
                    std::span<std::uint32_t> counts);

/// counts[i] = how many of `list` meet left[i] or right[i], of two chains that run against each other: where left
/// boxes grow, right ones shrink.
void count_in_either(std::span<const Segment> segments, const SegmentList& list, std::span<const Side> left,
                     std::span<const Side> right, std::span<std::uint32_t> counts);

}  // namespace boxwood
