#include "study/run_study.h"

#include <fmt/format.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "boxwood/ray_set.h"
#include "boxwood/structure.h"
#include "measure/clock.h"
#include "measure/probe.h"
#include "recipe/stage.h"
#include "structure/mesh_geometry.h"
#include "structure/object_use.h"
#include "structure/pipeline.h"
#include "study/observations.h"
#include "study/pictures.h"
#include "study/scene_finder.h"
#include "study/view_json.h"

namespace boxwood {
namespace {

/// One recipe while its scene is being measured.
struct Contestant {
  Recipe recipe;
  std::optional<Structure> structure;
  double build_cpu_ms = 0;
};

bool is_scene_wanted(const Study& study, const SceneSpec& scene) {
  const std::vector<std::string>& wanted = study.run.scenes;
  return wanted.empty() || std::ranges::find(wanted, scene.name) != wanted.end();
}

/// The recipes that are measured on a scene; those that are the same under two names once.
std::vector<Recipe> recipes_for(const Study& study, const SceneSpec& scene) {
  std::vector<Recipe> recipes;
  for (const RecipeSpec& spec : study.recipes) {
    if (!matches(spec.factors, scene.only)) continue;
    Recipe recipe = Recipe::parse(spec.text);
    if (std::ranges::find(recipes, recipe) == recipes.end()) recipes.push_back(std::move(recipe));
  }
  return recipes;
}

/// Steps on one scene, for the progress bar.
double steps_in(const Study& study, const SceneSpec& scene) {
  double per_structure = 0, per_rays = 0;
  for (const std::string& name : study.run.probes) {
    const Probe& probe = find_probe(name);
    if (probe.scope == ProbeScope::structure) {
      per_structure += probe.repeated ? study.run.builds : 1;
    } else {
      per_rays += probe.repeated ? study.run.repetitions : 1;
    }
  }
  const auto ray_sets = static_cast<double>(view_count(scene, study.run.frames) * study.run.rays.size());
  return static_cast<double>(recipes_for(study, scene).size()) * (per_structure + ray_sets * per_rays);
}

double steps_in(const Study& study) {
  double steps = 0;
  for (const SceneSpec& scene : study.scenes) {
    if (is_scene_wanted(study, scene)) steps += steps_in(study, scene);
  }
  return steps;
}

/// What all parts of a run share.
class Run {
 public:
  Run(const Study& study, Store& store, ProgressSink* progress)
      : study_(study),
        store_(store),
        progress_(progress),
        environment_(store.environment_number(this_environment())),
        done_(store.keys(stored_name(study), environment_)),
        all_steps_(steps_in(study)) {
    for (const std::string& name : study.run.probes) probes_.push_back(&find_probe(name));
  }

  std::int64_t environment() const { return environment_; }
  void announce(const std::string& what) { report_progress(progress_, fraction(), what); }
  void measure(const SceneSpec& spec, const StudyScene& scene);

 private:
  std::uint32_t repetitions(const Probe& probe) const {
    if (!probe.repeated) return 1;
    return probe.scope == ProbeScope::structure ? study_.run.builds : study_.run.repetitions;
  }

  Subject subject(const StudyScene& scene, const Contestant& contestant, const Probe& probe,
                  std::uint32_t repetition) const;
  Subject subject(const StudyScene& scene, const Camera& view, const std::string& rays, const Contestant& contestant,
                  const Probe& probe, std::uint32_t repetition) const;
  bool is_done(const Subject& subject) const { return done_.contains(subject.key()); }
  bool is_scene_done(const StudyScene& scene, const std::vector<Contestant>& contestants) const;
  RaySetSettings view_settings(const Camera& view) const;
  std::vector<RaySet> rays_of(const StudyScene& scene, const Camera& view, const Structure& structure) const;

  void step(const std::string& what) {
    steps_ += 1;
    announce(what);
  }

  /// Of what this run has to do: what an earlier one did took none of the time that the rest is foreseen from.
  double fraction() const {
    const double own = all_steps_ - skipped_;
    return own > 0 ? std::min(1.0, steps_ / own) : 1;
  }

  const ExpectedUse* use() const { return use_ ? &*use_ : nullptr; }
  void tell_use(const StudyScene& scene, const Camera& view, const std::vector<Contestant>& contestants);
  void build_one(const StudyScene& scene, Contestant& contestant);
  void rebuild(const StudyScene& scene, const Camera& view, std::vector<Contestant>& contestants);
  void draw(const StudyScene& scene, const std::vector<Contestant>& contestants);
  void build_structures(const StudyScene& scene, std::vector<Contestant>& contestants);
  void measure_rays(const StudyScene& scene, const Camera& view, const RaySet& rays,
                    std::vector<Contestant>& contestants);
  void probe_and_store(const Subject& subject, const Probe& probe, const ProbeInput& input);
  ProbeInput input(const StudyScene& scene, const Contestant& contestant, const RaySet* rays,
                   const RaySetSettings& view);
  const std::vector<Tree>& trees_of(const StudyScene& scene, const Contestant& contestant);

  const Study& study_;
  Store& store_;
  ProgressSink* progress_;
  std::int64_t environment_;
  std::set<std::string> done_;
  double steps_ = 0, skipped_ = 0, all_steps_;
  std::vector<const Probe*> probes_;
  std::vector<Tree> trees_;
  std::string trees_are_of_;
  std::optional<ExpectedUse> use_;
  std::string ray_settings_;  ///< of the scene that is being measured
};

Subject Run::subject(const StudyScene& scene, const Contestant& contestant, const Probe& probe,
                     std::uint32_t repetition) const {
  Subject s;
  s.study = stored_name(study_);
  s.scene = scene.name;
  s.scene_source = scene.source;
  s.scene_hash = scene.hash;
  s.triangles = scene.scene.placed_triangles();
  s.recipe = contestant.recipe.text();
  s.probe = probe.name;
  s.repetition = repetition;
  s.threads = study_.run.threads;
  return s;
}

Subject Run::subject(const StudyScene& scene, const Camera& view, const std::string& rays, const Contestant& contestant,
                     const Probe& probe, std::uint32_t repetition) const {
  Subject s = subject(scene, contestant, probe, repetition);
  s.view = view.name;
  s.camera = view_json(view, ray_settings_);
  s.width = study_.run.width;
  s.height = study_.run.height;
  s.rays = rays;
  s.seed = study_.run.seed;
  return s;
}

RaySetSettings Run::view_settings(const Camera& view) const {
  RaySetSettings settings;
  settings.camera = view;
  settings.width = study_.run.width;
  settings.height = study_.run.height;
  settings.seed = study_.run.seed;
  settings.bounces = study_.run.bounces;
  settings.ao_radius = study_.run.ao_radius;
  return settings;
}

/// Of all kinds that are measured, under the names that the study has for them.
std::vector<RaySet> Run::rays_of(const StudyScene& scene, const Camera& view, const Structure& structure) const {
  std::vector<std::string> kinds;
  for (const std::string& rays : study_.run.rays) kinds.push_back(rays.starts_with("diffuse") ? "diffuse" : rays);
  const std::optional<WholePaths>& paths = study_.run.whole_paths;
  const RaySetSettings settings = view_settings(view);
  std::vector<RaySet> sets = paths ? make_path_sets(scene.scene, structure, settings, *paths, kinds)
                                   : make_ray_sets(scene.scene, structure, settings, kinds);
  if (study_.run.bounces > 1) return sets;
  for (RaySet& rays : sets) {
    if (rays.kind == "diffuse1") rays.kind = "diffuse";
  }
  return sets;
}

bool Run::is_scene_done(const StudyScene& scene, const std::vector<Contestant>& contestants) const {
  for (const Contestant& contestant : contestants) {
    for (const Probe* probe : probes_) {
      for (std::uint32_t r = 0; r < repetitions(*probe); ++r) {
        if (probe->scope == ProbeScope::structure) {
          if (!is_done(subject(scene, contestant, *probe, r))) return false;
          continue;
        }
        for (const Camera& view : scene.views) {
          for (const std::string& kind : study_.run.rays) {
            if (!is_done(subject(scene, view, kind, contestant, *probe, r))) return false;
          }
        }
      }
    }
  }
  return true;
}

const std::vector<Tree>& Run::trees_of(const StudyScene& scene, const Contestant& contestant) {
  const std::string text = contestant.recipe.text();
  const std::string key = fmt::format("{} {}", scene.name, text);
  if (trees_are_of_ == key) return trees_;
  trees_.clear();
  if (contestant.recipe.stages().front().stage->kind != StageKind::peer) {
    const std::vector<Box> boxes = instance_boxes(scene.scene);
    for (std::uint32_t m = 0; m < scene.scene.meshes.size(); ++m) {
      std::optional<KnownUse> known;
      if (use_) known = use_of_mesh(*use_, scene.scene, m, boxes);
      trees_.push_back(tree_of(scene.scene.meshes[m], contestant.recipe, known ? &*known : nullptr));
    }
  }
  trees_are_of_ = key;
  return trees_;
}

ProbeInput Run::input(const StudyScene& scene, const Contestant& contestant, const RaySet* rays,
                      const RaySetSettings& view) {
  return {.scene = scene.scene,
          .structure = *contestant.structure,
          .rays = rays,
          .view = view,
          .build_cpu_ms = contestant.build_cpu_ms,
          .threads = study_.run.threads,
          .trees = [this, &scene, &contestant]() -> const std::vector<Tree>& { return trees_of(scene, contestant); },
          .use = use()};
}

void Run::probe_and_store(const Subject& subject, const Probe& probe, const ProbeInput& input) {
  std::vector<StoredValue> values;
  for (const Value& value : probe.run(input)) {
    if (!std::isfinite(value.value)) continue;
    values.push_back({value.metric, find_metric(value.metric).unit, value.value});
  }
  store_.add(subject, values, environment_);
}

/// What a view traces, for recipes that adapt to it and for the probe that judges trees by it.
void Run::tell_use(const StudyScene& scene, const Camera& view, const std::vector<Contestant>& contestants) {
  constexpr std::uint32_t block = 4;  // as the SAH alternatives study thins its rays
  use_.reset();
  const bool wanted =
      std::ranges::any_of(probes_, [](const Probe* probe) { return probe->name == "quality"; }) ||
      std::ranges::any_of(contestants, [](const Contestant& contestant) { return needs_use(contestant.recipe); });
  if (!wanted) return;
  announce("tracing what recipes may know of " + scene.name);
  RaySetSettings settings = view_settings(view);
  settings.block = block;
  const std::optional<WholePaths>& paths = study_.run.whole_paths;
  use_ = paths ? expect_paths(scene.scene, settings, *paths) : expect_view(scene.scene, settings);
}

void Run::build_one(const StudyScene& scene, Contestant& contestant) {
  contestant.structure.reset();  // the old one must not take memory from the new one
  const double begin = now(Clock::thread_cpu);
  contestant.structure = build(scene.scene, contestant.recipe, {.threads = study_.run.threads, .use = use()});
  contestant.build_cpu_ms = 1e3 * (now(Clock::thread_cpu) - begin);
}

/// Those that adapt to rays, for the rays of another view.
void Run::rebuild(const StudyScene& scene, const Camera& view, std::vector<Contestant>& contestants) {
  tell_use(scene, view, contestants);
  for (Contestant& contestant : contestants) {
    if (needs_use(contestant.recipe)) build_one(scene, contestant);
  }
}

/// Every recipe once per round, in turn; the structures of the last round stay.
void Run::build_structures(const StudyScene& scene, std::vector<Contestant>& contestants) {
  const RaySetSettings view = view_settings(scene.views.front());
  for (std::uint32_t round = 0; round < study_.run.builds; ++round) {
    for (Contestant& contestant : contestants) {
      std::vector<std::pair<Subject, const Probe*>> missing;
      for (const Probe* probe : probes_) {
        if (probe->scope != ProbeScope::structure || round >= repetitions(*probe)) continue;
        Subject what = subject(scene, contestant, *probe, round);
        if (is_done(what)) {
          skipped_ += 1;
          continue;
        }
        missing.emplace_back(std::move(what), probe);
        step("building " + scene.name);
      }
      const bool last = round + 1 == study_.run.builds;
      if (missing.empty() && !(last && !contestant.structure)) continue;
      build_one(scene, contestant);
      for (const auto& [what, probe] : missing) {
        probe_and_store(what, *probe, input(scene, contestant, nullptr, view));
      }
    }
  }
  trees_.clear();
  trees_are_of_.clear();
}

void Run::measure_rays(const StudyScene& scene, const Camera& view, const RaySet& rays,
                       std::vector<Contestant>& contestants) {
  const RaySetSettings settings = view_settings(view);
  for (const Probe* probe : probes_) {
    if (probe->scope != ProbeScope::rays) continue;
    const auto what = [&](const Contestant& contestant, std::uint32_t repetition) {
      return subject(scene, view, rays.kind, contestant, *probe, repetition);
    };
    bool warm = !probe->repeated;
    for (std::uint32_t repetition = 0; repetition < repetitions(*probe); ++repetition) {
      for (const Contestant& contestant : contestants) {
        const Subject missing = what(contestant, repetition);
        if (is_done(missing)) {
          skipped_ += 1;
          continue;
        }
        step(fmt::format("{}, {}, {}", scene.name, view.name, rays.kind));
        if (!warm) {
          for (const Contestant& one : contestants) probe->run(input(scene, one, &rays, settings));
          warm = true;
        }
        probe_and_store(missing, *probe, input(scene, contestant, &rays, settings));
      }
    }
  }
}

void Run::draw(const StudyScene& scene, const std::vector<Contestant>& contestants) {
  std::vector<PicturedRecipe> pictured;
  for (const RecipeSpec& recipe : study_.recipes) {
    if (std::ranges::find(study_.pictures, recipe.label) == study_.pictures.end()) continue;
    const auto found = std::ranges::find_if(
        contestants, [&](const Contestant& contestant) { return contestant.recipe.text() == recipe.text; });
    if (found != contestants.end()) pictured.push_back({recipe.label, &*found->structure});
  }
  announce("drawing " + scene.name);
  keep_pictures(study_, scene, pictured, store_);
}

void Run::measure(const SceneSpec& spec, const StudyScene& scene) {
  ray_settings_ = ray_settings_json(study_.run, spec);
  std::vector<Contestant> contestants;
  for (Recipe& recipe : recipes_for(study_, spec)) contestants.push_back({std::move(recipe), {}, 0});
  if (contestants.empty()) return;
  if (is_scene_done(scene, contestants)) {
    skipped_ += steps_in(study_, spec);
    return;
  }
  tell_use(scene, scene.views.front(), contestants);
  build_structures(scene, contestants);
  draw(scene, contestants);
  const bool with_rays =
      std::ranges::any_of(probes_, [](const Probe* probe) { return probe->scope == ProbeScope::rays; });
  for (std::size_t number = 0; with_rays && number < scene.views.size(); ++number) {
    const Camera& view = scene.views[number];
    if (number > 0 && spec.rebuild > 0 && number % spec.rebuild == 0) rebuild(scene, view, contestants);
    for (RaySet& rays : rays_of(scene, view, *contestants.front().structure)) {
      measure_rays(scene, view, rays, contestants);
    }
  }
}

}  // namespace

std::string stored_name(const Study& study) {
  return study.quick ? study.name + std::string(quick_suffix) : study.name;
}

std::int64_t run_study(const Study& study, Store& store, const StudySettings& settings, ProgressSink* progress) {
  store.keep_study({stored_name(study), study.file_text});
  Run run(study, store, progress);
  tbb::task_arena arena(static_cast<int>(study.run.threads));
  for (const SceneSpec& spec : study.scenes) {
    if (!is_scene_wanted(study, spec)) continue;
    run.announce("loading " + spec.name);
    const StudyScene scene = find_scene(spec, settings.scene_folders, study.run.frames);
    if (scene.stand_in) {
      settings.note(
          fmt::format("{} stands in for the scene '{}': {} is not there", scene.source, spec.name, spec.find.front()));
    }
    arena.execute([&] { run.measure(spec, scene); });
  }
  return run.environment();
}

}  // namespace boxwood
