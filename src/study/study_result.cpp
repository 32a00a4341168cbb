#include "study/study_result.h"

#include "measure/significance.h"
#include "study/run_study.h"

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

}  // namespace

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
