#include "peer_bench.h"

#ifdef BOXWOOD_EMBREE
#include <fmt/format.h>
#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <memory>
#include <optional>

#include "boxwood/structure.h"
#include "build_bench.h"
#include "embree_builder.h"
#include "embree_calls.h"
#include "measure/interleave.h"
#include "recipe/stage.h"
#include "workspace.h"

namespace boxwood::cli {
namespace {

constexpr std::size_t rays_at_once = 4096;
/// How many of each side are timed in turn after all were timed once.
constexpr std::size_t finalists = 2;

constexpr std::pair<const char*, RTCBuildQuality> qualities[] = {
    {"low", RTC_BUILD_QUALITY_LOW}, {"medium", RTC_BUILD_QUALITY_MEDIUM}, {"high", RTC_BUILD_QUALITY_HIGH}};

using Device = std::unique_ptr<RTCDeviceTy, decltype(&rtcReleaseDevice)>;

/// Everything that traces the rays of one scene.
struct Tracers {
  std::vector<std::pair<std::string, Structure>> ours;
  std::vector<std::pair<std::string, std::unique_ptr<EmbreeScene>>> embree;
};

struct NamedRun {
  std::string name;
  Contestant run;
};

/// Keeps about `most` rays: whole calls, so that they stay as coherent as they are, from all over the set.
void keep_spread_calls(std::vector<Ray>& rays, std::size_t most) {
  const std::size_t calls = rays.size() / rays_at_once, kept = std::max<std::size_t>(most / rays_at_once, 1);
  if (calls <= kept) return;
  for (std::size_t i = 0; i < kept; ++i) {
    const std::size_t from = i * calls / kept;  // never before i
    if (from == i) continue;
    std::copy_n(rays.begin() + static_cast<std::ptrdiff_t>(from * rays_at_once), rays_at_once,
                rays.begin() + static_cast<std::ptrdiff_t>(i * rays_at_once));
  }
  rays.resize(kept * rays_at_once);
}

/// Seconds that `part(begin, end)` takes for all of `count` rays.
template <class Part>
double time_in_parts(std::size_t count, unsigned threads, const Part& part) {
  return run_in_arena(threads, [&] {
    const double begin = now(clock_for(threads));
    tbb::parallel_for(
        tbb::blocked_range<std::size_t>(0, count, rays_at_once),
        [&](const auto& range) { part(range.begin(), range.end()); }, tbb::simple_partitioner());
    return now(clock_for(threads)) - begin;
  });
}

/// The answers of the last run of each side.
struct PeerAnswers {
  std::vector<Hit> hits;
  std::vector<std::uint8_t> blocked;
  std::vector<float> t;

  std::uint64_t mismatches(const RaySet& set) const {
    std::uint64_t different = 0;
    for (std::size_t i = 0; i < set.rays.size(); ++i) {
      const bool ours = set.query == Query::closest_hit ? hits[i].valid() : blocked[i] != 0;
      const bool theirs = set.query == Query::closest_hit ? t[i] < set.rays[i].t_far : t[i] < 0;
      if (ours != theirs) {
        ++different;
      } else if (ours && set.query == Query::closest_hit) {
        different += std::fabs(t[i] - hits[i].t) > 1e-4f * std::fabs(hits[i].t) ? 1 : 0;
      }
    }
    return different;
  }
};

void trace_single(const Structure& structure, const RaySet& set, std::size_t begin, std::size_t end,
                  PeerAnswers& answers) {
  for (std::size_t i = begin; i < end; ++i) {
    if (set.query == Query::closest_hit)
      answers.hits[i] = structure.closest_hit(set.rays[i]);
    else
      answers.blocked[i] = structure.any_hit(set.rays[i]) ? 1 : 0;
  }
}

void trace_batch(const Structure& structure, const RaySet& set, std::size_t begin, std::size_t end,
                 PeerAnswers& answers) {
  const auto rays = std::span(set.rays).subspan(begin, end - begin);
  if (set.query == Query::closest_hit)
    structure.closest_hits(rays, std::span(answers.hits).subspan(begin, end - begin));
  else
    structure.any_hits(rays, std::span(answers.blocked).subspan(begin, end - begin));
}

std::vector<NamedRun> our_runs(const Tracers& tracers, const RaySet& set, bool batch, unsigned threads,
                               PeerAnswers& answers) {
  std::vector<NamedRun> out;
  for (const auto& [name, structure] : tracers.ours) {
    out.push_back({name, [&, batch, threads, traced = &structure] {
                     return time_in_parts(set.rays.size(), threads, [&](std::size_t begin, std::size_t end) {
                       (batch ? trace_batch : trace_single)(*traced, set, begin, end, answers);
                     });
                   }});
  }
  return out;
}

std::vector<NamedRun> embree_runs(const Tracers& tracers, const RaySet& set, bool batch, unsigned threads,
                                  PeerAnswers& answers) {
  std::vector<NamedRun> out;
  for (const auto& [quality, scene] : tracers.embree) {
    for (std::size_t call = 0; call < (batch ? embree_call_names.size() : 1); ++call) {
      out.push_back({fmt::format("embree.{}.{}", quality, embree_call_names[call]),
                     [&, threads, call = static_cast<EmbreeCall>(call), traced = scene.get()] {
                       return time_in_parts(set.rays.size(), threads, [&](std::size_t begin, std::size_t end) {
                         traced->trace(set, begin, end, call, answers.t);
                       });
                     }});
    }
  }
  return out;
}

/// The fastest of `runs` by one run each, after one that is not timed.
std::vector<NamedRun> fastest(std::vector<NamedRun> runs) {
  std::vector<std::pair<double, std::size_t>> order;
  for (std::size_t i = 0; i < runs.size(); ++i) {
    runs[i].run();
    order.emplace_back(runs[i].run(), i);
  }
  std::ranges::sort(order);
  std::vector<NamedRun> out;
  for (std::size_t i = 0; i < std::min(finalists, order.size()); ++i) out.push_back(runs[order[i].second]);
  return out;
}

std::size_t index_of_fastest(const std::vector<std::vector<double>>& seconds, std::size_t begin, std::size_t end) {
  std::size_t best = begin;
  for (std::size_t i = begin; i < end; ++i) {
    if (median(seconds[i]) < median(seconds[best])) best = i;
  }
  return best;
}

PeerColumn measure(const std::string& name, std::vector<NamedRun> ours, const std::vector<NamedRun>& theirs,
                   std::uint32_t repeats) {
  const std::size_t split = ours.size();
  ours.insert(ours.end(), theirs.begin(), theirs.end());
  std::vector<Contestant> runs;
  runs.reserve(ours.size());
  for (const NamedRun& run : ours) runs.push_back(run.run);
  const auto seconds = interleave(runs, {.repeats = repeats, .warmup = 0});
  const std::size_t best = index_of_fastest(seconds, 0, split);
  const std::size_t peer = index_of_fastest(seconds, split, seconds.size());
  PeerColumn column{name, ours[best].name, ours[peer].name, estimate_ratio(seconds[peer], seconds[best]), {}, 0, 0};
  for (std::size_t i = 0; i < repeats; ++i) column.ratios.push_back(seconds[peer][i] / seconds[best][i]);
  return column;
}

class SceneBench {
 public:
  SceneBench(const PeerScene& which, const PeerBenchSettings& settings, const std::function<void(double)>& report)
      : settings_(settings), scene_(load_peer_scene(which)), report_(report) {
    out_.scene = which.name;
    out_.triangles = scene_.unique_triangles();
  }

  PeerSceneBench run() {
    measure_builds();
    report_(0.4);
    build_tracers();
    report_(0.5);
    const std::vector<RaySet> sets = make_sets();
    for (std::size_t i = 0; i < sets.size(); ++i) {
      if (!sets[i].rays.empty()) measure_rays(sets[i]);
      report_(0.5 + 0.5 * static_cast<double>(i + 1) / static_cast<double>(sets.size()));
    }
    return std::move(out_);
  }

 private:
  NamedRun build_run(const std::string& text) const {
    const Recipe recipe = Recipe::parse(text);
    return {text, [this, recipe] {
              return run_in_arena(settings_.threads,
                                  [&] { return build_seconds(scene_, recipe, clock_for(settings_.threads)); });
            }};
  }

  void measure_builds() {
    for (const auto& [preset, quality] :
         {std::pair{"fast", "low"}, std::pair{"default", "medium"}, std::pair{"best", "high"}}) {
      out_.columns.push_back(measure(fmt::format("build.{}", preset), {build_run(preset)},
                                     {build_run(fmt::format("embree(quality={})", quality))}, settings_.build_repeats));
    }
  }

  void build_tracers() {
    for (const Preset& preset : presets()) {
      Structure structure = build(scene_, preset.name);
      out_.bytes_per_triangle.emplace_back(
          preset.name, static_cast<double>(structure.report().bytes) / static_cast<double>(out_.triangles));
      tracers_.ours.emplace_back(preset.name, std::move(structure));
    }
    for (const auto& [name, quality] : qualities) {
      tracers_.embree.emplace_back(name, std::make_unique<EmbreeScene>(device_.get(), scene_.meshes.front(), quality));
    }
  }

  std::vector<RaySet> make_sets() const {
    RaySetSettings view;
    view.camera = scene_.cameras.front();
    view.width = view.height = settings_.side;
    view.random_rays = static_cast<std::uint32_t>(settings_.most_rays);
    const std::vector<std::string> kinds = {"primary", "diffuse", "random", "shadow", "ao"};
    std::vector<RaySet> sets = make_ray_sets(scene_, tracers_.ours.front().second, view, kinds);
    for (RaySet& set : sets) keep_spread_calls(set.rays, settings_.most_rays);
    return sets;
  }

  void measure_rays(const RaySet& set) {
    const bool closest = set.query == Query::closest_hit;
    const std::string kind = set.kind == "diffuse1" ? "diffuse" : set.kind;
    PeerAnswers answers;
    answers.hits.resize(closest ? set.rays.size() : 0);
    answers.blocked.resize(closest ? 0 : set.rays.size());
    answers.t.resize(set.rays.size());
    for (const bool batch : {true, false}) {
      const auto ours = fastest(our_runs(tracers_, set, batch, settings_.threads, answers));
      const auto theirs = fastest(embree_runs(tracers_, set, batch, settings_.threads, answers));
      PeerColumn column =
          measure(fmt::format("{}.{}.{}", closest ? "closest" : "any", kind, batch ? "batch" : "single"), ours, theirs,
                  settings_.repeats);
      column.rays = set.rays.size();
      column.mismatches = answers.mismatches(set);
      out_.columns.push_back(std::move(column));
    }
  }

  const PeerBenchSettings& settings_;
  Scene scene_;
  std::function<void(double)> report_;
  PeerSceneBench out_;
  Device device_{rtcNewDevice(nullptr), rtcReleaseDevice};  // outlives the scenes in it
  Tracers tracers_;
};

/// Of the columns that every scene has.
std::vector<std::pair<std::string, Estimate>> means_over(const std::vector<PeerSceneBench>& scenes) {
  std::vector<std::pair<std::string, Estimate>> out;
  for (const PeerColumn& first : scenes.front().columns) {
    std::vector<double> logarithms(first.ratios.size());
    std::size_t found = 0;
    for (const PeerSceneBench& scene : scenes) {
      const auto column = std::ranges::find(scene.columns, first.name, &PeerColumn::name);
      if (column == scene.columns.end()) continue;
      ++found;
      for (std::size_t i = 0; i < logarithms.size(); ++i) logarithms[i] += std::log(column->ratios[i]);
    }
    std::vector<double> means;
    means.reserve(logarithms.size());
    for (const double sum : logarithms) means.push_back(std::exp(sum / static_cast<double>(found)));
    out.emplace_back(first.name, estimate_median(means));
  }
  return out;
}

}  // namespace

PeerBench bench_against_embree(const PeerBenchSettings& settings, ProgressSink& progress) {
  PeerBench bench;
  bench.threads = settings.threads;
  for (std::size_t i = 0; i < settings.scenes.size(); ++i) {
    const auto report = [&](double done) {
      progress.report((static_cast<double>(i) + done) / static_cast<double>(settings.scenes.size()),
                      settings.scenes[i].name);
    };
    bench.scenes.push_back(SceneBench(settings.scenes[i], settings, report).run());
  }
  if (!bench.scenes.empty()) bench.geometric_means = means_over(bench.scenes);
  return bench;
}

}  // namespace boxwood::cli
#else
namespace boxwood::cli {

PeerBench bench_against_embree(const PeerBenchSettings& settings, ProgressSink&) { return {settings.threads, {}, {}}; }

}  // namespace boxwood::cli
#endif
