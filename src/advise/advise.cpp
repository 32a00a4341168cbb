#include "advise/advise.h"

#include <fmt/format.h>
#include <tbb/global_control.h>
#include <tbb/info.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <cmath>

#include "advise/candidates.h"
#include "advise/thin_scene.h"
#include "boxwood/structure.h"
#include "measure/clock.h"
#include "measure/correlation.h"
#include "measure/trace_rays.h"
#include "recipe/stage.h"
#include "structure/object_use.h"
#include "structure/pipeline.h"
#include "structure/tree_metrics.h"
#include "tree/statistics.h"

namespace boxwood {
namespace {

constexpr const char* reference_recipe = "default";
constexpr std::size_t probes = 10;         ///< recipes that tell whether a thinned scene predicts
constexpr double least_correlation = 0.8;  ///< that it must reach
constexpr double indifference = 0.02;      ///< of speed, within which building faster counts more
constexpr std::size_t thin_kept = 36, screened = 14, finalists = 7;
constexpr std::uint32_t epo_samples = 20'000;

/// Every step-th ray.
std::vector<RaySet> thinned(std::span<const RaySet> sets, std::size_t step) {
  std::vector<RaySet> out;
  for (const RaySet& set : sets) {
    out.push_back({set.kind, set.query, {}});
    for (std::size_t i = 0; i < set.rays.size(); i += step) out.back().rays.push_back(set.rays[i]);
  }
  return out;
}

std::size_t count_rays(std::span<const RaySet> sets) {
  std::size_t rays = 0;
  for (const RaySet& set : sets) rays += set.rays.size();
  return rays;
}

std::vector<Recipe> recipes_of(std::span<const Trial> trials) {
  std::vector<Recipe> out;
  for (const Trial& trial : trials) out.push_back(trial.recipe);
  return out;
}

/// A scene with all that measuring on it takes.
struct Ground {
  const Scene* scene;
  Structure reference;
  ExpectedUse use;

  Ground(const Scene& the_scene, std::span<const RaySet> rays, const AdviseSettings& settings)
      : scene(&the_scene),
        reference(build(the_scene, reference_recipe, {.threads = settings.threads})),
        use(expect_use(reference, rays, rays)) {
    use.views = settings.views;
  }
};

class Search {
 public:
  Search(const Scene& scene, std::span<const RaySet> ray_sets, const AdviseSettings& settings, ProgressSink* progress)
      : scene_(scene), sets_(ray_sets), settings_(settings), progress_(progress), begin_(now(Clock::wall)) {
    advice_.scene = scene.name;
    advice_.triangles = scene.placed_triangles();
  }

  Advice run() {
    std::vector<Recipe> recipes = candidate_recipes();
    advice_.candidates = recipes.size();
    const std::vector<RaySet> some = thinned(sets_, 4), few = thinned(sets_, 16);
    const Ground whole(scene_, few, settings_);
    std::vector<Trial> known;
    try {
      if (settings_.exhaustive) {
        known = round(whole, recipes, some, 3, 0, finalists);
      } else {
        if (scene_.unique_triangles() > settings_.thin_from) recipes = screen_thinned(whole, recipes, few, known);
        known = round(whole, recipes, few, 2, 0.55, screened);
        known = round(whole, recipes_of(known), some, 5, 0.75, finalists);
      }
    } catch (const Cancelled&) {
      if (known.empty()) throw;
      advice_.interrupted = true;
    }
    if (known.empty()) no_candidate();
    finish(whole, known);
    return std::move(advice_);
  }

 private:
  double deadline(double share) const { return share == 0 ? 0 : begin_ + share * settings_.seconds; }

  /// One round on `ground`: measures, notes what was done, and returns who goes on.
  std::vector<Trial> round(const Ground& ground, std::span<const Recipe> recipes, std::span<const RaySet> rays,
                           std::uint32_t repeats, double share_of_time, std::size_t keep) {
    const double begin = now(Clock::wall);
    const Limits limits = limits_on(*ground.scene);
    std::vector<Trial> trials = measure(ground, recipes, rays, repeats, share_of_time);
    std::vector<Trial> kept = survivors(trials, keep, limits);
    AdviceRound done{ground.scene->unique_triangles(), count_rays(rays), trials.size(), 0, 0, kept.size(),
                     now(Clock::wall) - begin};
    for (const Trial& trial : trials) {
      if (!trial.refused.empty()) {
        ++done.refused;
      } else if (!trial.measured) {
        ++done.not_reached;
      }
    }
    advice_.rounds.push_back(done);
    return kept;
  }

  std::vector<Trial> measure(const Ground& ground, std::span<const Recipe> recipes, std::span<const RaySet> rays,
                             std::uint32_t repeats, double share_of_time) {
    TrialSettings trial;
    trial.repeats = repeats;
    trial.threads = settings_.threads;
    trial.deadline = deadline(share_of_time);
    trial.use = &ground.use;
    return run_trials(*ground.scene, recipes, ground.reference, rays, trial, progress_);
  }

  /// Of a thinned scene: in proportion to its triangles, with some room, because small scenes build a little faster
  /// per triangle.
  Limits limits_on(const Scene& scene) const {
    const double share = static_cast<double>(scene.unique_triangles()) / static_cast<double>(scene_.unique_triangles());
    if (share >= 1) return settings_.limits;
    return {settings_.limits.build_ms * share, settings_.limits.bytes * share * 1.1};
  }

  /// Who is worth building on the whole scene, by a thinned one, if that predicts; else evenly picked candidates, as
  /// many as there is time for.
  std::vector<Recipe> screen_thinned(const Ground& whole, std::span<const Recipe> recipes, std::span<const RaySet> rays,
                                     std::vector<Trial>& known) {
    const Scene thin = thin_scene(scene_, settings_.thin_triangles);
    const Ground ground(thin, rays, settings_);
    std::vector<Recipe> some;
    for (std::size_t i = 0; i < probes; ++i) some.push_back(recipes[i * recipes.size() / probes]);
    advice_.thin_correlation = correlation(measure(ground, some, rays, 3, 0), measure(whole, some, rays, 3, 0));
    advice_.thin_used = *advice_.thin_correlation >= least_correlation;
    if (!advice_.thin_used) return {recipes.begin(), recipes.end()};
    known = round(ground, recipes, rays, 2, 0.35, thin_kept);
    return recipes_of(known);
  }

  static double correlation(std::span<const Trial> a, std::span<const Trial> b) {
    std::vector<double> x, y;
    for (std::size_t i = 0; i < a.size(); ++i) {
      if (!a[i].measured || !b[i].measured) continue;
      x.push_back(a[i].ratio.median);
      y.push_back(b[i].ratio.median);
    }
    return spearman(x, y);
  }

  [[noreturn]] void no_candidate() const {
    throw Error(fmt::format("no recipe of {} keeps the limits on {}; allow more memory, build time or time to search",
                            advice_.candidates, scene_.name));
  }

  void finish(const Ground& whole, std::span<const Trial> known) {
    std::vector<Recipe> recipes = recipes_of(known);
    const Recipe reference = Recipe::parse(reference_recipe);
    if (std::ranges::find(recipes, reference) == recipes.end()) recipes.push_back(reference);
    CompareSettings compare_settings;
    compare_settings.repeats = advice_.interrupted ? 3 : settings_.repeats;
    compare_settings.threads = settings_.threads;
    compare_settings.use = &whole.use;
    compare_settings.build_seconds = 0.2 * settings_.seconds;
    const Comparison comparison =
        compare(scene_, recipes, sets_, compare_settings, advice_.interrupted ? nullptr : progress_);
    for (const RecipeRow& row : comparison.rows) advice_.rows.push_back(row_of(row));
    advice_.notes = comparison.disagreements;
    std::ranges::stable_sort(advice_.rows, std::ranges::greater{}, &AdviceRow::mrays_per_s);
    mark_front();
    recommend();
    advice_.reference = static_cast<std::size_t>(
        std::ranges::find(advice_.rows, reference.text(), [](const AdviceRow& row) { return row.measured.recipe; }) -
        advice_.rows.begin());
    advice_.why = reason(advice_.rows[advice_.recommended], whole);
    advice_.reference_why = reason(advice_.rows[advice_.reference], whole);
    count_blocked(whole);
  }

  /// Speed over all rays: those of a kind weigh as many as they are.
  static AdviceRow row_of(const RecipeRow& row) {
    double rays = 0, seconds = 0, least = 0, most = 0;
    for (const RayKindRow& kind : row.rays) {
      if (kind.rays == 0) continue;
      const double millions = static_cast<double>(kind.rays) * 1e-6;
      rays += millions;
      seconds += millions / kind.mrays_per_s.median;
      least += millions / kind.mrays_per_s.high;
      most += millions / kind.mrays_per_s.low;
    }
    return {row, rays / seconds, rays / most, rays / least, false};
  }

  void mark_front() {
    for (AdviceRow& row : advice_.rows) {
      row.on_front = std::ranges::none_of(advice_.rows, [&](const AdviceRow& other) {
        return &other != &row && other.mrays_per_s >= row.mrays_per_s &&
               other.measured.build_ms.median <= row.measured.build_ms.median &&
               other.measured.bytes <= row.measured.bytes;
      });
    }
  }

  bool keeps_limits(const AdviceRow& row) const {
    const Limits& limits = settings_.limits;
    return (limits.build_ms == 0 || row.measured.build_ms.median <= limits.build_ms) &&
           (limits.bytes == 0 || static_cast<double>(row.measured.bytes) <= limits.bytes);
  }

  void recommend() {
    double fastest = 0;
    for (const AdviceRow& row : advice_.rows) {
      if (keeps_limits(row)) fastest = std::max(fastest, row.mrays_per_s);
    }
    if (fastest == 0) no_candidate();
    double build_ms = INFINITY;
    for (std::size_t i = 0; i < advice_.rows.size(); ++i) {
      const AdviceRow& row = advice_.rows[i];
      if (!keeps_limits(row) || row.mrays_per_s < (1 - indifference) * fastest) continue;
      if (row.measured.build_ms.median >= build_ms) continue;
      build_ms = row.measured.build_ms.median;
      advice_.recommended = i;
    }
  }

  AdviceReason reason(const AdviceRow& row, const Ground& whole) const {
    AdviceReason out;
    out.sah = row.measured.sah_cost;
    double rays = 0;
    for (const RayKindRow& kind : row.measured.rays) {
      const auto count = static_cast<double>(kind.rays);
      rays += count;
      out.node_tests_per_ray += count * kind.node_tests_per_ray;
      out.primitive_tests_per_ray += count * kind.primitive_tests_per_ray;
    }
    out.node_tests_per_ray /= std::max(rays, 1.0);
    out.primitive_tests_per_ray /= std::max(rays, 1.0);
    const auto largest = std::ranges::max_element(scene_.meshes, {}, [](const Mesh& m) { return m.triangles.size(); });
    if (!scene_.single_level()) return out;  // a use of the whole scene is not one of a mesh
    const KnownUse use = use_of_mesh(whole.use, scene_, 0, {});
    const Tree tree = tree_of(*largest, Recipe::parse(row.measured.recipe), &use);
    out.epo = tree_metrics(tree, *largest, KnownUse{}, epo_samples).overlap.epo;
    return out;
  }

  void count_blocked(const Ground& whole) {
    std::size_t rays = 0, blocked = 0;
    for (const RaySet& set : sets_) {
      if (set.query != Query::any_hit) continue;
      Answers answers(set);
      trace_rays(whole.reference, set, answers);
      rays += set.rays.size();
      blocked += hits_in(answers);
    }
    if (rays > 0) advice_.blocked_share = static_cast<double>(blocked) / static_cast<double>(rays);
  }

  const Scene& scene_;
  std::span<const RaySet> sets_;
  const AdviseSettings& settings_;
  ProgressSink* progress_;
  double begin_;
  Advice advice_;
};

}  // namespace

Advice advise(const Scene& scene, std::span<const RaySet> ray_sets, const AdviseSettings& settings,
              ProgressSink* progress) {
  if (count_rays(ray_sets) == 0) throw UsageError("advice needs rays that are to be traced");
  const auto available = static_cast<unsigned>(tbb::info::default_concurrency());
  const unsigned threads = settings.threads > 0 ? settings.threads : available;
  const tbb::global_control allow(tbb::global_control::max_allowed_parallelism, std::max(threads, available));
  tbb::task_arena arena(static_cast<int>(threads));
  return arena.execute([&] { return Search(scene, ray_sets, settings, progress).run(); });
}

}  // namespace boxwood
