#include "measure/trace_rays.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>
#include <tbb/parallel_reduce.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <span>

namespace boxwood {
namespace {

constexpr std::size_t chunk = 4096;

using Range = tbb::blocked_range<std::size_t>;

template <class T>
auto part(T& values, const Range& range) {
  return std::span(values).subspan(range.begin(), range.size());
}

bool alike(const Hit& a, const Hit& b) {
  if (!a.valid() || !b.valid()) return a.valid() == b.valid();
  return std::fabs(a.t - b.t) <= 1e-4f * std::max(std::fabs(a.t), std::fabs(b.t));
}

/// `counters`: RayCounters or CounterTotals.
template <class Counters>
CounterTotals sum(CounterTotals totals, const Counters& counters) {
  totals.steps += counters.steps;
  totals.leaves += counters.leaves;
  totals.node_tests += counters.node_tests;
  totals.node_hits += counters.node_hits;
  totals.primitive_tests += counters.primitive_tests;
  return totals;
}

}  // namespace

Answers::Answers(const RaySet& set) {
  if (set.query == Query::closest_hit) {
    hits.resize(set.rays.size());
  } else {
    blocked.resize(set.rays.size());
  }
}

void trace_rays(const Structure& structure, const RaySet& set, Answers& answers) {
  tbb::parallel_for(
      Range(0, set.rays.size(), chunk),
      [&](const Range& range) {
        if (set.query == Query::closest_hit) {
          structure.closest_hits(part(set.rays, range), part(answers.hits, range));
        } else {
          structure.any_hits(part(set.rays, range), part(answers.blocked, range));
        }
      },
      tbb::simple_partitioner());
}

std::uint64_t hits_in(const Answers& answers) {
  return static_cast<std::uint64_t>(std::ranges::count_if(answers.hits, &Hit::valid) +
                                    std::ranges::count_if(answers.blocked, [](std::uint8_t b) { return b != 0; }));
}

std::uint64_t mismatches(const Answers& a, const Answers& b, bool exact) {
  std::uint64_t different = 0;
  for (std::size_t i = 0; i < a.hits.size(); ++i) {
    if (!(exact ? a.hits[i] == b.hits[i] : alike(a.hits[i], b.hits[i]))) ++different;
  }
  for (std::size_t i = 0; i < a.blocked.size(); ++i) {
    if ((a.blocked[i] != 0) != (b.blocked[i] != 0)) ++different;
  }
  return different;
}

CounterTotals count_tests(const Structure& structure, const RaySet& set) {
  return tbb::parallel_reduce(
      Range(0, set.rays.size(), chunk), CounterTotals{},
      [&](const Range& range, const CounterTotals& totals) {
        std::vector<RayCounters> counters(range.size());
        if (set.query == Query::closest_hit) {
          std::vector<Hit> hits(range.size());
          structure.closest_hits_counted(part(set.rays, range), hits, counters);
        } else {
          std::vector<std::uint8_t> blocked(range.size());
          structure.any_hits_counted(part(set.rays, range), blocked, counters);
        }
        return std::accumulate(counters.begin(), counters.end(), totals, sum<RayCounters>);
      },
      sum<CounterTotals>, tbb::simple_partitioner());
}

}  // namespace boxwood
