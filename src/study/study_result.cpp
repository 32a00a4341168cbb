#include "study/study_result.h"

#include <algorithm>

#include "measure/significance.h"
#include "study/run_study.h"
#include "study/spread.h"
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

/// Points of one panel that none of the others beats.
void mark_front(PlotResult& plot) {
  const auto [better_x, better_y] = *plot.spec.front;
  const auto cost = [](const Estimate& e, PlotSpec::Better better) {
    return better == PlotSpec::Better::low ? e.median : -e.median;
  };
  const auto same_panel = [&](std::size_t a, std::size_t b) {
    return std::ranges::all_of(plot.spec.panels, [&](const std::string& factor) {
      return plot.cells[a].factors.at(factor) == plot.cells[b].factors.at(factor);
    });
  };
  for (std::size_t i = 0; i < plot.cells.size(); ++i) {
    const double x = cost(plot.x[i], better_x), y = cost(plot.cells[i].estimate, better_y);
    bool beaten = false;
    for (std::size_t j = 0; j < plot.cells.size() && !beaten; ++j) {
      if (!same_panel(i, j)) continue;
      const double other_x = cost(plot.x[j], better_x), other_y = cost(plot.cells[j].estimate, better_y);
      beaten = other_x <= x && other_y <= y && (other_x < x || other_y < y);
    }
    plot.on_front[i] = !beaten;
  }
}

TableResult table_result(const Study& study, const Observations& observations, const TableSpec& spec) {
  if (spec.spread.empty()) {
    return {spec, cells(study, observations, spec.figure, joined(spec.rows, spec.columns))};
  }
  TableResult table{spec, spread_cells(study, observations, spec.figure, spec.rows, spec.spread)};
  table.spec.columns = {spread_factor};
  return table;
}

PlotResult plot_result(const Study& study, const Observations& observations, const PlotSpec& spec) {
  std::vector<std::string> factors = joined(spec.panels, spec.series);
  if (!spec.x_is_figure) factors.push_back(spec.x);
  PlotResult plot{spec, cells(study, observations, spec.figure, factors), {}, {}};
  if (!spec.x_is_figure) return plot;
  FigureSpec x = spec.figure;
  x.value = spec.x;
  const std::vector<Cell> all = std::move(plot.cells);
  const std::vector<std::optional<Cell>> beside = cells_beside(study, observations, x, all);
  plot.cells.clear();
  for (std::size_t i = 0; i < all.size(); ++i) {
    if (!beside[i]) continue;
    plot.cells.push_back(all[i]);
    plot.x.push_back(beside[i]->estimate);
  }
  plot.on_front.assign(plot.cells.size(), false);
  if (spec.front) mark_front(plot);
  return plot;
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
    result.tables.push_back(table_result(study, observations, spec));
  }
  for (const PlotSpec& spec : study.plots) {
    result.plots.push_back(plot_result(study, observations, spec));
  }
  for (const ClaimSpec& spec : study.claims) result.claims.push_back(judge(study, observations, spec));
  return result;
}

}  // namespace boxwood
