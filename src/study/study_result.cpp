#include "study/study_result.h"

#include "measure/significance.h"
#include "study/run_study.h"
#include "study/study_file.h"

namespace boxwood {
namespace {

/// Timings of one kind are those that differ in their repetition only.
std::uint64_t count_outliers(const std::vector<Measurement>& measurements) {
  std::map<std::string, std::vector<double>> series;
  for (const Measurement& m : measurements) {
    Subject subject = m.subject;
    subject.repetition = 0;
    for (const StoredValue& value : m.values) series[subject.key() + value.metric].push_back(value.value);
  }
  std::uint64_t count = 0;
  for (const auto& [key, samples] : series) count += outliers(samples);
  return count;
}

std::vector<std::string> joined(std::vector<std::string> a, const std::vector<std::string>& b) {
  a.insert(a.end(), b.begin(), b.end());
  return a;
}

/// The study as it was run; quick runs are stored under a name that says so.
Study stored_study(const StoredStudy& stored) {
  const bool quick = stored.name.ends_with(quick_suffix);
  const std::string name = stored.name.substr(0, stored.name.size() - (quick ? quick_suffix.size() : 0));
  return parse_study(stored.text, name + ".toml", quick);
}

}  // namespace

std::vector<StudyResult> evaluate_all(const Store& store) {
  std::vector<StudyResult> results;
  for (const StoredStudy& stored : store.studies()) {
    const std::vector<Measurement> measurements = store.measurements({.study = stored.name});
    if (measurements.empty()) continue;
    results.push_back(evaluate(stored_study(stored), store, measurements.back().environment));
  }
  return results;
}

StudyResult evaluate(const Study& study, const Store& store, std::int64_t environment) {
  StudyResult result;
  result.study = study;
  result.environment = store.environment(environment);
  const Observations observations(study, store, environment);
  result.scenes = observations.scenes();
  const std::vector<Measurement> measurements =
      store.measurements({.study = stored_name(study), .environment = environment});
  result.measurements = measurements.size();
  result.outliers = count_outliers(measurements);
  result.pictures = store.pictures(stored_name(study));
  for (const TableSpec& spec : study.tables) {
    result.tables.push_back({spec, cells(study, observations, spec.figure, joined(spec.rows, spec.columns))});
  }
  for (const PlotSpec& spec : study.plots) {
    result.plots.push_back(
        {spec, cells(study, observations, spec.figure, joined(joined(spec.panels, spec.series), {spec.x}))});
  }
  for (const ClaimSpec& spec : study.claims) result.claims.push_back(judge(study, observations, spec));
  return result;
}

}  // namespace boxwood
