#include "render/tracer.h"

#include <algorithm>
#include <chrono>

namespace boxwood {
namespace {

template <class Work>
double seconds_of(const Work& work) {
  const auto begin = std::chrono::steady_clock::now();
  work();
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
}

std::uint64_t count_hits(std::span<const Hit> hits) {
  return static_cast<std::uint64_t>(std::ranges::count_if(hits, &Hit::valid));
}

}  // namespace

void Tracer::closest_hits(std::string_view kind, std::span<const Ray> rays, std::span<Hit> hits) {
  const double seconds = seconds_of([&] { structure_.closest_hits(rays, hits); });
  add_report(reports_, {std::string(kind), rays.size(), count_hits(hits), seconds});
}

void Tracer::any_hits(std::string_view kind, std::span<const Ray> rays, std::span<std::uint8_t> blocked) {
  const double seconds = seconds_of([&] { structure_.any_hits(rays, blocked); });
  const auto hits =
      static_cast<std::uint64_t>(rays.size()) - static_cast<std::uint64_t>(std::ranges::count(blocked, 0));
  add_report(reports_, {std::string(kind), rays.size(), hits, seconds});
}

void Tracer::closest_hits_counted(std::string_view kind, std::span<const Ray> rays, std::span<Hit> hits,
                                  std::span<RayCounters> counters) {
  const double seconds = seconds_of([&] { structure_.closest_hits_counted(rays, hits, counters); });
  add_report(reports_, {std::string(kind), rays.size(), count_hits(hits), seconds});
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
