#include "render/tracer.h"

#include <time.h>

#include <algorithm>

namespace boxwood {
namespace {

/// CPU time of this thread, which other work on the machine does not lengthen.
double thread_seconds() {
  timespec time;
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
  return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

template <class Work>
double seconds_of(const Work& work) {
  const double begin = thread_seconds();
  work();
  return thread_seconds() - begin;
}

std::uint64_t count_hits(std::span<const Hit> hits) {
  return static_cast<std::uint64_t>(std::ranges::count_if(hits, &Hit::valid));
}

}  // namespace

void Tracer::closest_hits(std::string_view kind, std::span<const Ray> rays, std::span<Hit> hits) {
  if (recorded_) recorded_->insert(recorded_->end(), rays.begin(), rays.end());
  const double seconds = seconds_of([&] { structure_.closest_hits(rays, hits); });
  add_report(reports_, {std::string(kind), Query::closest_hit, rays.size(), count_hits(hits), seconds});
}

void Tracer::any_hits(std::string_view kind, std::span<const Ray> rays, std::span<std::uint8_t> blocked) {
  const double seconds = seconds_of([&] { structure_.any_hits(rays, blocked); });
  const auto hits =
      static_cast<std::uint64_t>(rays.size()) - static_cast<std::uint64_t>(std::ranges::count(blocked, 0));
  add_report(reports_, {std::string(kind), Query::any_hit, rays.size(), hits, seconds});
}

void Tracer::closest_hits_counted(std::string_view kind, std::span<const Ray> rays, std::span<Hit> hits,
                                  std::span<RayCounters> counters) {
  const double seconds = seconds_of([&] { structure_.closest_hits_counted(rays, hits, counters); });
  add_report(reports_, {std::string(kind), Query::closest_hit, rays.size(), count_hits(hits), seconds});
}

void add_report(std::vector<RayKindReport>& reports, const RayKindReport& report) {
  const auto found = std::ranges::find(reports, report.kind, &RayKindReport::kind);
  if (found == reports.end()) {
    reports.push_back(report);
    return;
  }
  found->rays += report.rays;
  found->hits += report.hits;
  found->trace_seconds += report.trace_seconds;
}

}  // namespace boxwood
