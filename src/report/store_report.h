#pragma once
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "measure/statistics.h"
#include "report/json.h"
#include "store/store.h"

namespace boxwood {

/// One metric of one subject, over its repetitions.
struct StoredSeries {
  Subject subject;  ///< with repetition 0
  std::string metric, unit;
  std::int64_t environment = 0;
  std::vector<double> samples;
  std::string first_time, last_time;  ///< UTC
};

/// Measurements grouped into series, in the order in which they were first added. O(n log n).
std::vector<StoredSeries> stored_series(std::span<const Measurement> measurements);

std::string series_text(std::span<const StoredSeries> series);
std::string series_csv(std::span<const StoredSeries> series);
Json series_json(std::span<const StoredSeries> series);

/// A series that two stores both have: did anything change?
struct SeriesChange {
  Subject subject;
  std::string metric, unit;
  Estimate before, after;
  Estimate ratio;        ///< after / before; n = 0 when a sample is not positive
  double p_value = 1;    ///< Welch's test with Holm's correction over all changes
  bool changed = false;  ///< p below 0.05 and the interval of the ratio leaves out 1; for single samples: not equal
};

/// Series are the same when scene (by content), view, rays, recipe, probe, metric and settings are; the study's name,
/// machine and commit may differ. Several environments in one store are taken together.
std::vector<SeriesChange> changes(std::span<const StoredSeries> before, std::span<const StoredSeries> after);

/// `all`: also what did not change.
std::string changes_text(std::span<const SeriesChange> changes, bool all);
std::string changes_csv(std::span<const SeriesChange> changes);
Json changes_json(std::span<const SeriesChange> changes);

}  // namespace boxwood
