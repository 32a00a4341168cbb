#include "measure/interleave.h"

namespace boxwood {

std::vector<std::vector<double>> interleave(std::span<const Contestant> contestants, const InterleaveSettings& settings,
                                            ProgressSink* progress) {
  if (settings.repeats == 0) throw UsageError("repeats must be at least 1");
  std::vector<std::vector<double>> seconds(contestants.size());
  const std::uint64_t passes = std::uint64_t{settings.warmup} + settings.repeats;
  const double runs = static_cast<double>(passes) * static_cast<double>(contestants.size());
  double runs_done = 0;
  for (std::uint64_t pass = 0; pass < passes; ++pass) {
    for (std::size_t i = 0; i < contestants.size(); ++i) {
      const double taken = contestants[i]();
      if (pass >= settings.warmup) seconds[i].push_back(taken);
      report_progress(progress, ++runs_done / runs, "timing");
    }
  }
  return seconds;
}

}  // namespace boxwood
