#include "build_bench.h"

#include "embree_builder.h"
#include "structure/mesh_geometry.h"
#include "structure/pipeline.h"
#include "workspace.h"

namespace boxwood::cli {
namespace {

std::vector<NamedContestant> contestants_of(const Scene& scene, const std::vector<std::string>& recipes,
                                            unsigned threads) {
  std::vector<NamedContestant> out;
  for (const std::string& text : recipes) {
    const Recipe recipe = Recipe::parse(text);
    out.push_back({recipe.text(), [&scene, recipe, threads] {
                     return run_in_arena(threads, [&] { return build_seconds(scene, recipe, clock_for(threads)); });
                   }});
  }
  return out;
}

Estimate ns_per_triangle(const std::vector<double>& seconds, double triangles) {
  std::vector<double> samples;
  samples.reserve(seconds.size());
  for (const double value : seconds) samples.push_back(value * 1e9 / triangles);
  return estimate_median(samples);
}

}  // namespace

double build_seconds(const Scene& scene, const Recipe& recipe, Clock clock) {
  const double begin = now(clock);
  const Pipeline pipeline(recipe);
  const MeshGeometry geometry(scene.meshes.front());
  Contents contents;
  contents.mesh = &scene.meshes.front();
  const auto layout = pipeline.encode(pipeline.tree({geometry.references(), &geometry}), contents);
  return now(clock) - begin;
}

BuildBench bench_builds(const BuildBenchSettings& settings, ProgressSink& progress) {
  const Scene scene = load_scene(settings.scene);
  const auto triangles = static_cast<double>(scene.unique_triangles());
  std::vector<NamedContestant> contestants = contestants_of(scene, settings.recipes, settings.threads);
  const std::size_t ours = contestants.size();
  if (settings.peers) {
    for (auto& peer : embree_commits(scene, {"low", "medium"}, settings.threads))
      contestants.push_back(std::move(peer));
    for (auto& peer : embree_builders(scene, settings.threads)) contestants.push_back(std::move(peer));
  }
  std::vector<Contestant> runs;
  runs.reserve(contestants.size());
  for (const NamedContestant& contestant : contestants) runs.push_back(contestant.run);
  const auto seconds = interleave(runs, {.repeats = settings.repeats, .warmup = 1}, &progress);

  BuildBench bench{scene.name, scene.unique_triangles(), {}};
  for (std::size_t i = 0; i < contestants.size(); ++i) {
    BuildRow row{contestants[i].name, ns_per_triangle(seconds[i], triangles), std::nullopt, {}};
    for (std::size_t peer = ours; peer < contestants.size(); ++peer) {
      row.ratios.emplace_back(contestants[peer].name, estimate_ratio(seconds[peer], seconds[i]));
    }
    if (i < ours) row.peak = peak_memory_of(contestants[i].run);
    bench.rows.push_back(std::move(row));
  }
  return bench;
}

}  // namespace boxwood::cli
