#include "measure/compare.h"

#include <fmt/format.h>
#include <tbb/global_control.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <optional>
#include <set>

#include "boxwood/saved.h"
#include "boxwood/structure.h"
#include "measure/clock.h"
#include "measure/interleave.h"
#include "measure/trace_rays.h"
#include "recipe/capabilities.h"
#include "recipe/stage.h"

namespace boxwood {
namespace {

/// Maps the 0…1 of a part of the work onto a range of the whole.
class PartOfProgress final : public ProgressSink {
 public:
  PartOfProgress(ProgressSink* whole, double low, double high) : whole_(whole), low_(low), high_(high) {}
  bool report(double fraction, std::string_view what) override {
    return !whole_ || whole_->report(low_ + (high_ - low_) * fraction, what);
  }

 private:
  ProgressSink* whole_;
  double low_, high_;
};

constexpr double share_of_building = 0.3;  // of the progress; a guess

void check(std::span<const Recipe> recipes, std::span<const RaySet> ray_sets, const CompareSettings& settings) {
  if (recipes.empty() && settings.saved.empty()) throw UsageError("a comparison needs at least one recipe");
  if (ray_sets.empty()) throw UsageError("a comparison needs at least one ray set");
  std::set<std::string_view> kinds;
  for (const RaySet& set : ray_sets) {
    if (!kinds.insert(set.kind).second) {
      throw UsageError(fmt::format("there are two ray sets of kind '{}'; name them apart", set.kind));
    }
  }
}

bool is_peer(const Recipe& recipe) { return recipe.stages().front().stage->kind == StageKind::peer; }

/// Loads a saved structure into `structure`. Returns how long it took.
double load_timed(const Scene& scene, const std::filesystem::path& file, std::optional<Structure>& structure) {
  const double begin = now(Clock::wall);
  structure = load_structure(file);
  const double milliseconds = (now(Clock::wall) - begin) * 1000;
  check_fits(*structure, scene);
  return milliseconds;
}

/// Builds all recipes in turn, several times, into `structures`, and loads what is saved likewise. Returns milliseconds
/// per contestant and round.
std::vector<std::vector<double>> build_all(const Scene& scene, std::span<const Recipe> recipes,
                                           const CompareSettings& settings,
                                           std::vector<std::optional<Structure>>& structures, ProgressSink* progress) {
  std::vector<Contestant> contestants;
  for (std::size_t i = 0; i < recipes.size(); ++i) {
    contestants.push_back([&, i] {
      structures[i].reset();  // the old one must not take memory from the new one
      structures[i] = build(scene, recipes[i], {.threads = settings.threads, .use = settings.use});
      return structures[i]->report().build_ms;
    });
  }
  for (std::size_t i = 0; i < settings.saved.size(); ++i) {
    contestants.push_back([&, i] { return load_timed(scene, settings.saved[i], structures[recipes.size() + i]); });
  }
  PartOfProgress first_round(progress, 0, share_of_building / 2);
  const double begin = now(Clock::wall);
  std::vector<std::vector<double>> milliseconds = interleave(contestants, {.repeats = 1, .warmup = 0}, &first_round);
  const double round_seconds = now(Clock::wall) - begin;

  const double affordable = settings.build_seconds / std::max(round_seconds, 1e-9);
  const auto rounds = static_cast<std::uint32_t>(std::min<double>(settings.build_repeats, affordable));
  if (rounds < 2) return milliseconds;
  PartOfProgress other_rounds(progress, share_of_building / 2, share_of_building);
  const auto more = interleave(contestants, {.repeats = rounds - 1, .warmup = 0}, &other_rounds);
  for (std::size_t i = 0; i < more.size(); ++i) {
    milliseconds[i].insert(milliseconds[i].end(), more[i].begin(), more[i].end());
  }
  return milliseconds;
}

RecipeRow describe_build(const Structure& structure, std::span<const double> milliseconds) {
  const BuildReport& report = structure.report();
  RecipeRow row;
  row.recipe = structure.recipe().text();
  row.peer = is_peer(structure.recipe());
  row.exact = answers_exactly(structure.recipe().stages());
  row.build_ms = estimate_median(milliseconds);
  row.bytes = report.bytes;
  if (report.primitives > 0) {
    row.bytes_per_triangle = static_cast<double>(report.bytes) / static_cast<double>(report.primitives);
  }
  row.sah_cost = report.sah_cost;
  return row;
}

/// What is not measured in time: answers, agreement with `reference`, counters.
RayKindRow count(const Structure& structure, const RaySet& set, const Answers& reference, bool exact) {
  RayKindRow row;
  row.kind = set.kind;
  row.rays = set.rays.size();
  Answers answers(set);
  trace_rays(structure, set, answers);
  row.hits = hits_in(answers);
  row.mismatches = mismatches(answers, reference, exact);
  if (set.rays.empty()) return row;

  const CounterTotals totals = count_tests(structure, set);
  const auto rays = static_cast<double>(row.rays);
  row.node_tests_per_ray = static_cast<double>(totals.node_tests) / rays;
  row.primitive_tests_per_ray = static_cast<double>(totals.primitive_tests) / rays;
  row.steps_per_ray = static_cast<double>(totals.steps) / rays;
  row.leaves_per_ray = static_cast<double>(totals.leaves) / rays;
  return row;
}

/// Fills in the times of one ray set, interleaved over all recipes.
void time_rays(std::span<const std::optional<Structure>> structures, const RaySet& set, std::size_t set_index,
               const CompareSettings& settings, std::vector<RecipeRow>& rows, ProgressSink* progress) {
  if (set.rays.empty()) return;
  const Clock clock = settings.threads == 1 ? Clock::thread_cpu : Clock::wall;
  Answers answers(set);
  std::vector<Contestant> contestants;
  for (const std::optional<Structure>& structure : structures) {
    contestants.push_back([&] {
      const double begin = now(clock);
      trace_rays(*structure, set, answers);
      // A clock that has not moved would make an infinite speed.
      return std::max(now(clock) - begin, 1e-9);
    });
  }
  const auto seconds = interleave(contestants, {settings.repeats, settings.warmup}, progress);

  for (std::size_t i = 0; i < rows.size(); ++i) {
    RayKindRow& row = rows[i].rays[set_index];
    std::vector<double> speeds, logarithms;
    for (std::size_t repeat = 0; repeat < seconds[i].size(); ++repeat) {
      speeds.push_back(static_cast<double>(row.rays) * 1e-6 / seconds[i][repeat]);
      logarithms.push_back(std::log(seconds[0][repeat] / seconds[i][repeat]));
    }
    row.mrays_per_s = estimate_median(speeds);
    row.ratio = estimate_ratio(seconds[0], seconds[i]);
    row.ratio_p_value = signed_rank_p_value(logarithms);
  }
}

void report_disagreements(Comparison& comparison, std::string_view reference) {
  for (const RecipeRow& row : comparison.rows) {
    for (const RayKindRow& kind : row.rays) {
      if (kind.mismatches == 0) continue;
      comparison.disagreements.push_back(fmt::format("{} answers {} of {} {} rays otherwise than {}", row.recipe,
                                                     kind.mismatches, kind.rays, kind.kind, reference));
    }
  }
}

Comparison compare_in_arena(const Scene& scene, std::span<const Recipe> recipes, std::span<const RaySet> ray_sets,
                            const CompareSettings& settings, ProgressSink* progress) {
  Comparison comparison;
  comparison.scene = scene.name;
  comparison.triangles = scene.placed_triangles();
  report_progress(progress, 0, "building");
  std::vector<std::optional<Structure>> structures(recipes.size() + settings.saved.size());
  const auto milliseconds = build_all(scene, recipes, settings, structures, progress);
  for (std::size_t i = 0; i < structures.size(); ++i) {
    comparison.rows.push_back(describe_build(*structures[i], milliseconds[i]));
    if (i >= recipes.size()) comparison.rows.back().file = settings.saved[i - recipes.size()].string();
  }

  const auto ours = std::ranges::find(comparison.rows, true, &RecipeRow::exact);
  const std::size_t reference = ours == comparison.rows.end() ? 0 : ours - comparison.rows.begin();
  const double share = (1 - share_of_building) / static_cast<double>(ray_sets.size());
  for (std::size_t s = 0; s < ray_sets.size(); ++s) {
    const double begin = share_of_building + share * static_cast<double>(s);
    Answers expected(ray_sets[s]);
    trace_rays(*structures[reference], ray_sets[s], expected);
    for (std::size_t i = 0; i < structures.size(); ++i) {
      const bool exact = comparison.rows[i].exact && comparison.rows[reference].exact;
      comparison.rows[i].rays.push_back(count(*structures[i], ray_sets[s], expected, exact));
      report_progress(progress, begin, "checking");
    }
    PartOfProgress part(progress, begin, begin + share);
    time_rays(structures, ray_sets[s], s, settings, comparison.rows, &part);
  }
  report_disagreements(comparison, comparison.rows[reference].recipe);
  return comparison;
}

}  // namespace

Comparison compare(const Scene& scene, std::span<const Recipe> recipes, std::span<const RaySet> ray_sets,
                   const CompareSettings& settings, ProgressSink* progress) {
  check(recipes, ray_sets, settings);
  const auto available = static_cast<unsigned>(tbb::info::default_concurrency());
  const unsigned threads = settings.threads > 0 ? settings.threads : available;
  // As many as asked for, even if the machine has fewer.
  const tbb::global_control allow(tbb::global_control::max_allowed_parallelism, std::max(threads, available));
  tbb::task_arena arena(static_cast<int>(threads));
  return arena.execute([&] { return compare_in_arena(scene, recipes, ray_sets, settings, progress); });
}

}  // namespace boxwood
