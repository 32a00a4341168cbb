// Two stores side by side: did this machine, or this commit, change anything?
#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "measure/significance.h"
#include "report/csv.h"
#include "report/number_text.h"
#include "report/store_report.h"
#include "report/table.h"

namespace boxwood {
namespace {

constexpr double significance = 0.05;

/// Equal for series that may be compared.
std::string identity(const StoredSeries& series) {
  Subject subject = series.subject;
  subject.study.clear();
  subject.scene.clear();  // its content counts, not what it is called
  return fmt::format("{}\x1f{}", subject.key(), series.metric);
}

bool positive(const std::vector<double>& samples) {
  return std::ranges::all_of(samples, [](double x) { return x > 0; });
}

SeriesChange compare(const StoredSeries& series, const std::vector<double>& before, const std::vector<double>& after) {
  SeriesChange change{
      series.subject, series.metric, series.unit, estimate_median(before), estimate_median(after), {}, 1, false};
  if (positive(before) && positive(after)) change.ratio = bootstrap_ratio(after, before, false);
  change.p_value = welch_p_value(before, after);
  return change;
}

bool is_constant(const Estimate& estimate) { return estimate.low == estimate.high; }

}  // namespace

std::vector<SeriesChange> changes(std::span<const StoredSeries> before, std::span<const StoredSeries> after) {
  std::map<std::string, std::vector<double>> old_samples, new_samples;
  std::vector<const StoredSeries*> common;
  for (const StoredSeries& series : before) {
    std::vector<double>& samples = old_samples[identity(series)];
    samples.insert(samples.end(), series.samples.begin(), series.samples.end());
  }
  for (const StoredSeries& series : after) {
    const std::string key = identity(series);
    if (!old_samples.contains(key)) continue;
    std::vector<double>& samples = new_samples[key];
    if (samples.empty()) common.push_back(&series);
    samples.insert(samples.end(), series.samples.begin(), series.samples.end());
  }
  std::vector<SeriesChange> out;
  std::vector<double> p_values;
  for (const StoredSeries* series : common) {
    const std::string key = identity(*series);
    out.push_back(compare(*series, old_samples[key], new_samples[key]));
    p_values.push_back(out.back().p_value);
  }
  const std::vector<double> corrected = holm(p_values);
  for (std::size_t i = 0; i < out.size(); ++i) {
    SeriesChange& change = out[i];
    change.p_value = corrected[i];
    if (is_constant(change.before) && is_constant(change.after)) {
      change.changed = change.before.median != change.after.median;
    } else {
      change.changed = change.p_value < significance && (change.ratio.low > 1 || change.ratio.high < 1);
    }
  }
  return out;
}

std::string changes_text(std::span<const SeriesChange> changes, bool all) {
  Table table({{"where", Align::left},
               {"recipe", Align::left},
               {"metric", Align::left},
               {"before"},
               {"after"},
               {"after / before"},
               {"p"}});
  std::size_t changed = 0;
  for (const SeriesChange& change : changes) {
    changed += change.changed;
    if (!change.changed && !all) continue;
    const Subject& s = change.subject;
    table.add({s.rays.empty() ? s.scene : fmt::format("{} {} {}", s.scene, s.view, s.rays), s.recipe, change.metric,
               significant(change.before.median), significant(change.after.median),
               change.ratio.n == 0 ? "–" : with_interval(change.ratio), fmt::format("{:.2g}", change.p_value)});
  }
  const std::string summary =
      fmt::format("{} of {} in both stores changed.\n", changed, counted(changes.size(), "figure"));
  return table.empty() ? summary : fmt::format("{}\n{}", table.text(), summary);
}

std::string changes_csv(std::span<const SeriesChange> changes) {
  std::string out = csv_line({"scene", "view", "rays", "recipe", "metric", "unit", "before", "after", "ratio",
                              "ratio_low", "ratio_high", "p_value", "changed"});
  for (const SeriesChange& change : changes) {
    const Subject& s = change.subject;
    const bool with_ratio = change.ratio.n > 0;
    const auto ratio = [&](double x) { return with_ratio ? csv_number(x) : std::string(); };
    out += csv_line({s.scene, s.view, s.rays, s.recipe, change.metric, change.unit, csv_number(change.before.median),
                     csv_number(change.after.median), ratio(change.ratio.median), ratio(change.ratio.low),
                     ratio(change.ratio.high), csv_number(change.p_value), change.changed ? "yes" : "no"});
  }
  return out;
}

Json changes_json(std::span<const SeriesChange> changes) {
  Json out = Json::array();
  for (const SeriesChange& change : changes) {
    const Subject& s = change.subject;
    out.push_back({{"scene", s.scene},
                   {"view", s.view},
                   {"rays", s.rays},
                   {"recipe", s.recipe},
                   {"metric", change.metric},
                   {"unit", change.unit},
                   {"before", to_json(change.before)},
                   {"after", to_json(change.after)},
                   {"ratio", change.ratio.n == 0 ? Json() : to_json(change.ratio)},
                   {"p_value", change.p_value},
                   {"changed", change.changed}});
  }
  return out;
}

}  // namespace boxwood
