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
#include "render/ray_sets.h"
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

std::vector<NamedContestant> our_runs(const Tracers& tracers, const RaySet& set, bool batch, unsigned threads,
                                      PeerAnswers& answers) {
  std::vector<NamedContestant> out;
  for (const auto& [name, structure] : tracers.ours) {
    out.push_back({name, [&, batch, threads, traced = &structure] {
                     return time_in_parts(set.rays.size(), threads, [&](std::size_t begin, std::size_t end) {
                       (batch ? trace_batch : trace_single)(*traced, set, begin, end, answers);
                     });
                   }});
  }
  return out;
}

std::vector<NamedContestant> embree_runs(const Tracers& tracers, const RaySet& set, bool batch, unsigned threads,
                                         PeerAnswers& answers) {
  std::vector<NamedContestant> out;
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
std::vector<NamedContestant> fastest(std::vector<NamedContestant> runs) {
  std::vector<std::pair<double, std::size_t>> order;
  for (std::size_t i = 0; i < runs.size(); ++i) {
    runs[i].run();
    order.emplace_back(runs[i].run(), i);
  }
  std::ranges::sort(order);
  std::vector<NamedContestant> out;
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

PeerColumn measure(const std::string& name, std::vector<NamedContestant> ours,
                   const std::vector<NamedContestant>& theirs, const InterleaveSettings& settings) {
  const std::size_t split = ours.size();
  ours.insert(ours.end(), theirs.begin(), theirs.end());
  std::vector<Contestant> runs;
  runs.reserve(ours.size());
  for (const NamedContestant& run : ours) runs.push_back(run.run);
  const auto seconds = interleave(runs, settings);
  const std::size_t best = index_of_fastest(seconds, 0, split);
  const std::size_t peer = index_of_fastest(seconds, split, seconds.size());
  PeerColumn column{name, ours[best].name, ours[peer].name, estimate_ratio(seconds[peer], seconds[best]), {}, 0, 0};
  for (std::size_t i = 0; i < settings.repeats; ++i) column.ratios.push_back(seconds[peer][i] / seconds[best][i]);
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
  /// Short builds are timed several at once.
  NamedContestant several(const std::string& name, const Contestant& build) const {
    return {name, [this, build] {
              std::size_t builds = 0;
              double seconds = 0;
              do {
                seconds += build();
                ++builds;
              } while (seconds < settings_.least_build_seconds);
              return seconds / static_cast<double>(builds);
            }};
  }

  void measure_builds() {
    for (const auto& [preset, quality] :
         {std::pair{"fast", "low"}, std::pair{"default", "medium"}, std::pair{"best", "high"}}) {
      const unsigned threads = settings_.threads;
      const NamedContestant ours = several(preset, [this, threads, recipe = Recipe::parse(preset)] {
        return run_in_arena(threads, [&] { return build_seconds(scene_, recipe, clock_for(threads)); });
      });
      const NamedContestant peer = embree_commits(scene_, {quality}, threads).front();
      out_.columns.push_back(measure(fmt::format("build.{}", preset), {ours}, {several(peer.name, peer.run)},
                                     {.repeats = settings_.build_repeats, .warmup = 1}));
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
    for (RaySet& set : sets) keep_spread_runs(set.rays, rays_at_once, settings_.most_rays);
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
                  {.repeats = settings_.repeats, .warmup = 0});
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
