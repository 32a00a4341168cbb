#include "study/observations.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "measure/probe.h"
#include "study/run_study.h"
#include "study/view_json.h"

namespace boxwood {
namespace {

constexpr double not_measured = std::numeric_limits<double>::quiet_NaN();

bool was_measured_with(const Study& study, const Subject& subject) {
  const RunSpec& run = study.run;
  if (subject.threads != run.threads) return false;
  if (subject.rays.empty()) return true;
  const auto scene = std::ranges::find(study.scenes, subject.scene, &SceneSpec::name);
  if (scene == study.scenes.end()) return false;
  return has_ray_settings(subject.camera, ray_settings_json(run, *scene)) && subject.width == run.width &&
         subject.height == run.height && subject.seed == run.seed &&
         std::ranges::find(run.rays, subject.rays) != run.rays.end();
}

/// Sample `repetition`; metrics with fewer samples start anew, so that a single one counts for all.
std::optional<double> sample(const std::map<std::string, std::vector<double>>& samples, const std::string& metric,
                             std::size_t repetition) {
  const auto found = samples.find(metric);
  if (found == samples.end() || found->second.empty()) return std::nullopt;
  const double value = found->second[repetition % found->second.size()];
  return std::isnan(value) ? std::nullopt : std::optional(value);
}

}  // namespace

bool depends_on_rays(const Expression& value) {
  for (const Probe& probe : probes()) {
    if (probe.scope != ProbeScope::rays) continue;
    for (const Metric& metric : probe.metrics) {
      if (value.metrics().contains(metric.name)) return true;
    }
  }
  return false;
}

bool matches(const Factors& factors, const Where& where) {
  return std::ranges::all_of(where, [&](const auto& wanted) {
    const auto found = factors.find(wanted.first);
    return found != factors.end() && std::ranges::find(wanted.second, found->second) != wanted.second.end();
  });
}

Observations::Observations(const Study& study, const Store& store, std::int64_t environment) : study_(study) {
  StoreFilter filter;
  filter.study = stored_name(study);
  filter.environment = environment;
  std::vector<Measurement> all = store.measurements(filter);
  std::erase_if(all, [&](const Measurement& m) { return !was_measured_with(study, m.subject); });

  std::map<std::string, SceneFacts> latest;
  for (const Measurement& m : all) {
    latest[m.subject.scene] = {m.subject.scene, m.subject.scene_source, m.subject.scene_hash, m.subject.triangles,
                               false};
  }
  for (const SceneSpec& spec : study.scenes) {
    const auto found = latest.find(spec.name);
    const std::vector<std::string>& wanted = study.run.scenes;
    if (found == latest.end()) continue;
    if (!wanted.empty() && std::ranges::find(wanted, spec.name) == wanted.end()) continue;
    found->second.stand_in = found->second.source != spec.find.front();
    scenes_.push_back(found->second);
  }
  for (const Measurement& m : all) {
    if (m.subject.scene_hash == latest.at(m.subject.scene).hash) add(m);
  }
}

void Observations::add(const Measurement& measurement) {
  const Subject& s = measurement.subject;
  Samples& samples = s.rays.empty() ? structures_[{s.scene, s.recipe}] : rays_[{s.scene, s.recipe, s.rays, s.view}];
  for (const StoredValue& value : measurement.values) {
    std::vector<double>& series = samples[value.metric];
    if (series.size() <= s.repetition) series.resize(s.repetition + 1, not_measured);
    series[s.repetition] = value.value;
  }
  if (s.view.empty()) return;
  std::vector<std::string>& views = views_[s.scene];
  if (std::ranges::find(views, s.view) == views.end()) views.push_back(s.view);
}

std::vector<std::string> Observations::views(const std::string& scene) const {
  const auto found = views_.find(scene);
  return found == views_.end() ? std::vector<std::string>() : found->second;
}

std::vector<double> Observations::samples(const Expression& value, const std::string& scene, const std::string& recipe,
                                          const std::string& rays, const std::string& view) const {
  static const Samples nothing;
  const auto structure = structures_.find({scene, recipe});
  const auto traced = rays_.find({scene, recipe, rays, view});
  const Samples& of_structure = structure == structures_.end() ? nothing : structure->second;
  const Samples& of_rays = traced == rays_.end() ? nothing : traced->second;

  std::size_t repetitions = 0;
  for (const std::string& metric : value.metrics()) {
    for (const Samples* samples : {&of_structure, &of_rays}) {
      if (const auto found = samples->find(metric); found != samples->end()) {
        repetitions = std::max(repetitions, found->second.size());
      }
    }
  }
  std::vector<double> out;
  for (std::size_t r = 0; r < repetitions; ++r) {
    const std::optional<double> result = value.evaluate([&](const std::string& metric) {
      const std::optional<double> found = sample(of_rays, metric, r);
      return found ? found : sample(of_structure, metric, r);
    });
    out.push_back(result.value_or(not_measured));
  }
  return out;
}

std::vector<double> Observations::mean_over_views(const Expression& value, const std::string& scene,
                                                  const std::string& recipe, const std::string& rays) const {
  std::vector<double> sum;
  const std::vector<std::string> all = views(scene);
  for (const std::string& view : all) {
    const std::vector<double> one = samples(value, scene, recipe, rays, view);
    if (one.empty()) return {};  // a view without figures would make the mean one of other views
    if (sum.empty()) {
      sum = one;
      continue;
    }
    sum.resize(std::min(sum.size(), one.size()));
    for (std::size_t r = 0; r < sum.size(); ++r) sum[r] += one[r];
  }
  for (double& x : sum) x /= static_cast<double>(all.size());
  return sum;
}

std::vector<Series> Observations::series(const Expression& value, bool each_view) const {
  std::vector<Series> out;
  const auto spec_of = [&](const SceneFacts& scene) -> const SceneSpec& {
    return *std::ranges::find(study_.scenes, scene.name, &SceneSpec::name);
  };
  const auto add_series = [&](const SceneFacts& scene, const RecipeSpec& recipe, Factors more,
                              std::vector<double> samples) {
    std::erase_if(samples, [](double x) { return std::isnan(x); });
    if (samples.empty()) return;
    const Factors& of_scene = spec_of(scene).set;
    more.insert(of_scene.begin(), of_scene.end());
    more.emplace("scene", scene.name);
    more["recipe"] = recipe.label;
    more.insert(recipe.factors.begin(), recipe.factors.end());
    out.push_back({std::move(more), std::move(samples)});
  };
  const bool with_rays = depends_on_rays(value);
  for (const SceneFacts& scene : scenes_) {
    for (const RecipeSpec& recipe : study_.recipes) {
      if (!with_rays) {
        add_series(scene, recipe, {}, samples(value, scene.name, recipe.text, "", ""));
        continue;
      }
      for (const std::string& rays : study_.run.rays) {
        if (!each_view) {
          add_series(scene, recipe, {{"rays", rays}}, mean_over_views(value, scene.name, recipe.text, rays));
          continue;
        }
        for (const std::string& view : views(scene.name)) {
          add_series(scene, recipe, {{"rays", rays}, {"view", view}},
                     samples(value, scene.name, recipe.text, rays, view));
        }
      }
    }
  }
  return out;
}

}  // namespace boxwood
