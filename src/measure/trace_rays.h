#pragma once
#include <cstdint>
#include <vector>

#include "boxwood/ray_set.h"
#include "boxwood/structure.h"

namespace boxwood {

/// Answers to a ray set: `hits` of its closest-hit rays, or `blocked` of its any-hit rays; the other is empty.
struct Answers {
  std::vector<Hit> hits;
  std::vector<std::uint8_t> blocked;

  explicit Answers(const RaySet& set);
};

/// Asks the set's query for every ray, in chunks of 4096, on the threads of the caller's TBB arena. Allocates nothing,
/// so that it can be timed.
void trace_rays(const Structure& structure, const RaySet& set, Answers& answers);

std::uint64_t hits_in(const Answers& answers);

/// Rays with different answers. Unless `exact`, hits are alike when both miss, or both hit at distances that differ by
/// at most a relative 1e-4.
std::uint64_t mismatches(const Answers& a, const Answers& b, bool exact);

/// RayCounters summed over many rays.
struct CounterTotals {
  std::uint64_t steps = 0, leaves = 0, node_tests = 0, node_hits = 0, primitive_tests = 0;
};

/// What all rays of the set cost together. Off the clock: the counting kernels are slower.
CounterTotals count_tests(const Structure& structure, const RaySet& set);

}  // namespace boxwood
