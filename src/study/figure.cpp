#include "study/figure.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "measure/probe.h"
#include "measure/significance.h"
#include "options/options.h"

namespace boxwood {
namespace {

/// A series, and what it is held against.
struct Member {
  const Series* series;
  const Series* baseline = nullptr;
};

bool is_exact(const Expression& value) {
  for (const Probe& probe : probes()) {
    for (const Metric& metric : probe.metrics) {
      if (probe.repeated && value.metrics().contains(metric.name)) return false;
    }
  }
  return true;
}

/// The factors that the baseline of `factors` must have. A recipe named in the baseline stands for all of its own.
Factors baseline_factors(const Factors& factors, const Where& baseline) {
  Factors wanted = factors;
  wanted.erase("recipe");
  for (const auto& [factor, levels] : baseline) wanted[factor] = levels.front();
  return wanted;
}

/// A candidate need not have all factors that are wanted (a binary tree has no mode of widening), but those it has must
/// be right, and those that the baseline names must be there.
bool is_baseline(const Factors& candidate, const Factors& wanted, const Where& baseline) {
  if (!matches(candidate, baseline)) return false;
  const bool by_recipe = baseline.contains("recipe");
  return std::ranges::all_of(candidate, [&](const auto& entry) {
    const bool place = entry.first == "scene" || entry.first == "rays" || entry.first == "view";
    if (!place && (by_recipe || entry.first == "recipe")) return true;
    const auto found = wanted.find(entry.first);
    return found != wanted.end() && found->second == entry.second;
  });
}

/// Null when it was not measured.
const Series* find_baseline(const std::vector<Series>& all, const Series& series, const Where& baseline) {
  const Factors wanted = baseline_factors(series.factors, baseline);
  const Series* found = nullptr;
  for (const Series& candidate : all) {
    if (!is_baseline(candidate.factors, wanted, baseline)) continue;
    if (found && found->samples != candidate.samples) {
      throw UsageError(fmt::format("the baseline of {} could be {} or {}; name more factors in 'baseline'",
                                   cell_name(series.factors), cell_name(found->factors), cell_name(candidate.factors)));
    }
    found = &candidate;
  }
  return found;
}

/// The samples of a metric of the scene, recipe, rays and view in `factors`; what depends on no rays has neither of the
/// latter. Null when it was not measured.
const std::vector<double>* samples_of(const std::vector<Series>& of_metric, const Factors& factors) {
  const auto found = std::ranges::find_if(of_metric, [&](const Series& series) {
    return std::ranges::all_of(series.factors, [&](const auto& entry) {
      const auto level = factors.find(entry.first);
      return level != factors.end() && level->second == entry.second;
    });
  });
  return found == of_metric.end() ? nullptr : &found->samples;
}

using MetricSeries = std::map<std::string, std::vector<Series>>;

/// Per repetition; metrics with fewer samples start anew.
std::vector<double> with_baseline(const Expression& value, const MetricSeries& metrics, const Factors& own,
                                  const Factors& baseline) {
  std::map<std::string, const std::vector<double>*> of_own, of_baseline;
  std::size_t repetitions = 0;
  for (const auto& [metric, series] : metrics) {
    of_own[metric] = samples_of(series, own);
    of_baseline[metric] = samples_of(series, baseline);
    if (!of_own[metric] || !of_baseline[metric]) return {};
    repetitions = std::max({repetitions, of_own[metric]->size(), of_baseline[metric]->size()});
  }
  std::vector<double> out;
  for (std::size_t r = 0; r < repetitions; ++r) {
    const auto sample = [r](const std::map<std::string, const std::vector<double>*>& all) {
      return [&all, r](const std::string& metric) {
        return std::optional(all.at(metric)->at(r % all.at(metric)->size()));
      };
    };
    if (const auto result = value.evaluate(sample(of_own), sample(of_baseline))) out.push_back(*result);
  }
  return out;
}

/// Of a value that names metrics of its baseline. Means over views are those of each metric, so that differences of two
/// recipes are taken over all views at once.
std::vector<Series> series_with_baseline(const Observations& observations, const Expression& value,
                                         const FigureSpec& figure) {
  MetricSeries metrics;
  const std::vector<Series>* subjects = nullptr;
  for (const std::string& name : value.metrics()) {
    const Expression metric = Expression::parse(name);
    metrics[name] = observations.series(metric, figure.each_view);
    if (!subjects || depends_on_rays(metric)) subjects = &metrics[name];
  }
  std::vector<Series> out;
  for (const Series& subject : *subjects) {
    if (!matches(subject.factors, figure.where)) continue;
    const Series* baseline = find_baseline(*subjects, subject, figure.baseline);
    if (!baseline) continue;
    std::vector<double> samples = with_baseline(value, metrics, subject.factors, baseline->factors);
    if (!samples.empty()) out.push_back({subject.factors, std::move(samples)});
  }
  return out;
}

std::vector<Member> members_of(const std::vector<Series>& all, const FigureSpec& figure) {
  const bool ratio = is_ratio(figure);
  std::vector<Member> members;
  for (const Series& series : all) {
    if (!matches(series.factors, figure.where)) continue;
    Member member{&series};
    if (ratio) {
      member.baseline = find_baseline(all, series, figure.baseline);
      if (!member.baseline) continue;
      const auto positive = [](const std::vector<double>& samples) {
        return std::ranges::all_of(samples, [](double x) { return x > 0; });
      };
      if (!positive(series.samples) || !positive(member.baseline->samples)) continue;
    }
    members.push_back(member);
  }
  return members;
}

/// Per repetition, as many as all have: the geometric or arithmetic mean.
std::vector<double> mean_series(const std::vector<const Series*>& all, bool geometric) {
  std::size_t repetitions = all.front()->samples.size();
  for (const Series* series : all) repetitions = std::min(repetitions, series->samples.size());
  std::vector<double> out;
  for (std::size_t r = 0; r < repetitions; ++r) {
    double sum = 0;
    for (const Series* series : all) sum += geometric ? std::log(series->samples[r]) : series->samples[r];
    sum /= static_cast<double>(all.size());
    out.push_back(geometric ? std::exp(sum) : sum);
  }
  return out;
}

void estimate(Cell& cell, const RunSpec& run) {
  const BootstrapSettings settings{.centre = run.centre == "mean" ? Centre::mean : Centre::median};
  if (cell.baseline.empty()) {
    cell.estimate = bootstrap_centre(cell.values, settings);
    cell.mean = mean(cell.values);
    return;
  }
  const std::size_t pairs = std::min(cell.values.size(), cell.baseline.size());
  cell.values.resize(pairs);
  cell.baseline.resize(pairs);
  cell.estimate = bootstrap_ratio(cell.baseline, cell.values, true, settings);
  cell.mean = mean(cell.baseline) / mean(cell.values);
}

double triangles_of(const Observations& observations, const std::string& scene) {
  const auto found = std::ranges::find(observations.scenes(), scene, &SceneFacts::name);
  return found == observations.scenes().end() ? 0 : static_cast<double>(found->triangles);
}

/// The levels of `each`; nothing when the series lacks one.
std::optional<Factors> levels_for(const Series& series, const std::vector<std::string>& each) {
  Factors out;
  for (const std::string& factor : each) {
    const auto found = series.factors.find(factor);
    if (found == series.factors.end()) return std::nullopt;
    out[factor] = found->second;
  }
  return out;
}

}  // namespace

bool is_ratio(const FigureSpec& figure) {
  return !figure.baseline.empty() && !Expression::parse(figure.value).names_baseline();
}

std::vector<Cell> cells(const Study& study, const Observations& observations, const FigureSpec& figure,
                        const std::vector<std::string>& each) {
  const Expression value = Expression::parse(figure.value);
  const std::vector<Series> all = value.names_baseline() ? series_with_baseline(observations, value, figure)
                                                         : observations.series(value, figure.each_view);
  std::vector<std::pair<Factors, std::vector<Member>>> groups;
  for (const Member& member : members_of(all, figure)) {
    const std::optional<Factors> levels = levels_for(*member.series, each);
    if (!levels) continue;
    const auto group = std::ranges::find(groups, *levels, &std::pair<Factors, std::vector<Member>>::first);
    if (group == groups.end()) {
      groups.push_back({*levels, {member}});
    } else {
      group->second.push_back(member);
    }
  }

  std::vector<Cell> out;
  for (const auto& [levels, members] : groups) {
    Cell cell;
    cell.factors = levels;
    cell.members = members.size();
    cell.exact = is_exact(value);
    std::vector<const Series*> values, baselines;
    for (const Member& member : members) {
      values.push_back(member.series);
      if (member.baseline) baselines.push_back(member.baseline);
      cell.triangles = std::max(cell.triangles, triangles_of(observations, member.series->factors.at("scene")));
    }
    cell.values = mean_series(values, !baselines.empty());
    if (!baselines.empty()) cell.baseline = mean_series(baselines, true);
    estimate(cell, study.run);
    out.push_back(std::move(cell));
  }
  return out;
}

std::vector<std::optional<Cell>> cells_beside(const Study& study, const Observations& observations,
                                              const FigureSpec& figure, const std::vector<Cell>& of) {
  const bool with_rays = depends_on_rays(Expression::parse(figure.value));
  std::vector<std::string> each;
  for (const Cell& cell : of) {
    for (const auto& [factor, level] : cell.factors) {
      const bool of_rays = factor == "rays" || factor == "view";
      if ((with_rays || !of_rays) && std::ranges::find(each, factor) == each.end()) each.push_back(factor);
    }
  }
  const std::vector<Cell> all = cells(study, observations, figure, each);
  std::vector<std::optional<Cell>> out;
  for (const Cell& cell : of) {
    const auto found = std::ranges::find_if(all, [&](const Cell& candidate) {
      return std::ranges::all_of(candidate.factors,
                                 [&](const auto& entry) { return cell.factors.at(entry.first) == entry.second; });
    });
    out.push_back(found == all.end() ? std::nullopt : std::optional(*found));
  }
  return out;
}

Cell quotient(const Study& study, const Cell& a, const Cell& b) {
  struct Fraction {
    double above, below;
  };
  const auto fraction = [](const Cell& cell, std::size_t repetition) {
    const std::size_t r = repetition % cell.values.size();
    return cell.baseline.empty() ? Fraction{cell.values[r], 1} : Fraction{cell.baseline[r], cell.values[r]};
  };
  const std::size_t repetitions =
      a.exact || b.exact ? std::max(a.values.size(), b.values.size()) : std::min(a.values.size(), b.values.size());
  Cell out = a;
  out.exact = a.exact && b.exact;
  out.values.clear();
  out.baseline.clear();
  for (std::size_t r = 0; r < repetitions; ++r) {
    const Fraction of_a = fraction(a, r), of_b = fraction(b, r);
    out.baseline.push_back(of_a.above * of_b.below);
    out.values.push_back(of_a.below * of_b.above);
  }
  estimate(out, study.run);
  return out;
}

std::string cell_name(const Factors& factors) {
  std::vector<std::string> parts;
  for (const auto& [factor, level] : factors) parts.push_back(fmt::format("{} {}", factor, level));
  return parts.empty() ? "all" : option_text::join(parts, ", ");
}

std::vector<std::string> levels_of(const std::vector<Cell>& cells, const std::string& factor) {
  std::vector<std::string> levels;
  for (const Cell& cell : cells) {
    const std::string& level = cell.factors.at(factor);
    if (std::ranges::find(levels, level) == levels.end()) levels.push_back(level);
  }
  return levels;
}

}  // namespace boxwood
