#pragma once
#include <span>
#include <string_view>
#include <vector>

#include "boxwood/structure.h"
#include "render/render.h"

namespace boxwood {

/// Traces batches of rays and keeps account of them by kind. For one thread.
class Tracer {
 public:
  explicit Tracer(const Structure& structure) : structure_(structure) {}

  void closest_hits(std::string_view kind, std::span<const Ray> rays, std::span<Hit> hits);
  void any_hits(std::string_view kind, std::span<const Ray> rays, std::span<std::uint8_t> blocked);
  void closest_hits_counted(std::string_view kind, std::span<const Ray> rays, std::span<Hit> hits,
                            std::span<RayCounters> counters);

  /// From now on, appends every closest-hit ray to `rays`, which must outlive the tracer's use.
  void record_closest(std::vector<Ray>& rays) { recorded_ = &rays; }

  /// In order of first use.
  const std::vector<RayKindReport>& reports() const { return reports_; }

 private:
  const Structure& structure_;
  std::vector<RayKindReport> reports_;
  std::vector<Ray>* recorded_ = nullptr;
};

/// Adds `report` to the one of its kind, or appends it.
void add_report(std::vector<RayKindReport>& reports, const RayKindReport& report);

}  // namespace boxwood
