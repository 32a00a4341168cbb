// What a store has, as series of samples: for a terminal, as CSV, as JSON.
#include <fmt/format.h>

#include <map>

#include "report/csv.h"
#include "report/number_text.h"
#include "report/store_report.h"
#include "report/table.h"

namespace boxwood {
namespace {

std::string place(const Subject& subject) {
  return subject.rays.empty() ? subject.scene : fmt::format("{} {} {}", subject.scene, subject.view, subject.rays);
}

}  // namespace

std::vector<StoredSeries> stored_series(std::span<const Measurement> measurements) {
  std::vector<StoredSeries> out;
  std::map<std::string, std::size_t> known;
  for (const Measurement& m : measurements) {
    Subject subject = m.subject;
    subject.repetition = 0;
    const std::string key = fmt::format("{}\x1f{}\x1f", subject.key(), m.environment);
    for (const StoredValue& value : m.values) {
      const auto [entry, is_new] = known.try_emplace(key + value.metric, out.size());
      if (is_new) out.push_back({subject, value.metric, value.unit, m.environment, {}, m.time, m.time});
      out[entry->second].samples.push_back(value.value);
      out[entry->second].last_time = m.time;
    }
  }
  return out;
}

std::string series_text(std::span<const StoredSeries> series) {
  Table table({{"where", Align::left}, {"recipe", Align::left}, {"metric", Align::left}, {"median"}, {"n"}});
  for (const StoredSeries& s : series) {
    const Estimate estimate = estimate_median(s.samples);
    const bool spread = estimate.low != estimate.high;
    std::string value = spread ? with_interval(estimate) : significant(estimate.median, 6);
    if (!s.unit.empty()) value += " " + s.unit;
    table.add({place(s.subject), s.subject.recipe, s.metric, value, std::to_string(estimate.n)});
  }
  return table.text();
}

std::string series_csv(std::span<const StoredSeries> series) {
  std::string out =
      csv_line({"study", "scene", "scene_source", "scene_hash", "triangles", "view", "width", "height", "rays",
                "recipe", "probe", "seed", "threads", "environment", "metric", "unit", "repetition", "value"});
  for (const StoredSeries& s : series) {
    const Subject& subject = s.subject;
    for (std::size_t r = 0; r < s.samples.size(); ++r) {
      out += csv_line({subject.study, subject.scene, subject.scene_source, fmt::format("{:016x}", subject.scene_hash),
                       std::to_string(subject.triangles), subject.view, std::to_string(subject.width),
                       std::to_string(subject.height), subject.rays, subject.recipe, subject.probe,
                       std::to_string(subject.seed), std::to_string(subject.threads), std::to_string(s.environment),
                       s.metric, s.unit, std::to_string(r), csv_number(s.samples[r])});
    }
  }
  return out;
}

Json series_json(std::span<const StoredSeries> series) {
  Json out = Json::array();
  for (const StoredSeries& s : series) {
    const Subject& subject = s.subject;
    out.push_back({{"study", subject.study},
                   {"scene", subject.scene},
                   {"scene_source", subject.scene_source},
                   {"scene_hash", fmt::format("{:016x}", subject.scene_hash)},
                   {"triangles", subject.triangles},
                   {"view", subject.view},
                   {"width", subject.width},
                   {"height", subject.height},
                   {"rays", subject.rays},
                   {"recipe", subject.recipe},
                   {"probe", subject.probe},
                   {"seed", subject.seed},
                   {"threads", subject.threads},
                   {"environment", s.environment},
                   {"metric", s.metric},
                   {"unit", s.unit},
                   {"first_time", s.first_time},
                   {"last_time", s.last_time},
                   {"value", to_json(estimate_median(s.samples))},
                   {"samples", s.samples}});
  }
  return out;
}

}  // namespace boxwood
