// `boxwood bench`: the project's own speed. How fast and in how much memory trees are built, and how fast the presets
// trace, as ratios to Embree in the same run.
#include <fmt/format.h>

#include <memory>

#include "boxwood/ray_set.h"
#include "build_bench.h"
#include "command.h"
#include "console.h"
#include "exit_code.h"
#include "measure/compare.h"
#include "peer_report.h"
#include "recipe/stage.h"
#include "report/comparison_text.h"
#include "report/json.h"
#include "report/number_text.h"
#include "report/progress_bar.h"
#include "report/table.h"
#include "workspace.h"

namespace boxwood::cli {
namespace {

struct BenchOptions {
  CommonOptions common{.threads = 1};
  std::string peer;    ///< "embree", or empty for none
  bool quick = false;  ///< small scenes and few repeats
  bool huge = false;   ///< also build 28 million triangles
  std::string scenes;  ///< folder of the scenes for the ratios to a peer; empty: see peer_scenes()
};

bool has_embree() {
  for (const Stage& stage : stages()) {
    if (stage.name == "embree") return true;
  }
  return false;
}

std::vector<BuildBench> bench_all_builds(const BenchOptions& options, bool peers) {
  BuildBenchSettings settings;
  settings.recipes = {"binned > binary", "binned > wide(8)", "sweep > binary",
                      "median > binary", "middle > binary",  "equal > binary"};
  settings.peers = peers;
  settings.repeats = options.quick ? 3 : 7;
  settings.threads = options.common.threads;
  std::vector<std::string> scenes = {"generate:terrain(size=708)", "generate:stadium"};
  if (options.quick) scenes = {"generate:terrain(size=100)"};
  std::vector<BuildBench> benches;
  for (const std::string& scene : scenes) {
    settings.scene = scene;
    ProgressBar bar(stop_requested());
    benches.push_back(bench_builds(settings, bar));
  }
  if (options.huge) {
    settings.scene = "generate:terrain(size=3742)";
    settings.recipes = {"binned > binary"};
    settings.peers = false;
    settings.repeats = 1;
    ProgressBar bar(stop_requested());
    benches.push_back(bench_builds(settings, bar));
  }
  return benches;
}

/// All presets on usual rays.
std::vector<Comparison> bench_tracing(const BenchOptions& options) {
  const std::uint32_t side = options.quick ? 64 : 512;
  std::vector<Comparison> comparisons;
  for (const char* path : {options.quick ? "generate:terrain(size=100)" : "generate:terrain(size=708)",
                           options.quick ? "generate:sphereflake" : "generate:stadium"}) {
    const Scene scene = load_scene(path);
    const std::vector<std::string> kinds = {"primary", "shadow", "ao", "diffuse"};
    RaySetSettings view;
    view.camera = scene.cameras.front();
    view.width = view.height = side;
    const std::vector<RaySet> ray_sets = make_ray_sets(scene, build(scene), view, kinds);
    std::vector<Recipe> recipes;
    for (const Preset& preset : presets()) recipes.push_back(Recipe::parse(preset.name));
    CompareSettings settings;
    settings.repeats = options.quick ? 3 : 11;
    settings.build_repeats = 1;
    settings.threads = options.common.threads;
    ProgressBar bar(stop_requested());
    comparisons.push_back(compare(scene, recipes, ray_sets, settings, &bar));
  }
  return comparisons;
}

/// Ratios to Embree on one thread and on all.
std::vector<PeerBench> bench_peer(const BenchOptions& options) {
  PeerBenchSettings settings;
  settings.scenes = peer_scenes(options.scenes, options.quick);
  if (options.quick) {
    settings.repeats = 3;
    settings.least_build_seconds = 0;
    settings.side = 32;
    settings.most_rays = 1024;
  }
  std::vector<PeerBench> out;
  for (const unsigned threads : {1u, 0u}) {
    settings.threads = threads;
    ProgressBar bar(stop_requested());
    out.push_back(bench_against_embree(settings, bar));
  }
  return out;
}

int report_peer(const BenchOptions& options) {
  const std::vector<PeerBench> benches = bench_peer(options);
  if (!options.common.json) {
    for (const PeerBench& bench : benches) print(fmt::format("{}\n", peer_text(bench)));
    print("Ratios are speeds over the peer's in the same round: above 1, boxwood is faster.\n");
    return exit_done;
  }
  Json document = peer_json(benches.front());
  document["peer"] = options.peer;
  document["all_threads"] = peer_json(benches.back());
  print_json(document);
  return exit_done;
}

std::string build_text(const BuildBench& bench) {
  std::vector<Table::Column> columns = {{"build", Align::left}, {"ns/triangle"}, {"peak bytes/triangle"}, {"peak"}};
  for (const auto& ratio : bench.rows.front().ratios) columns.push_back({fmt::format("× {}", ratio.first)});
  Table table(columns);
  for (const BuildRow& row : bench.rows) {
    std::vector<std::string> cells = {row.recipe, with_interval(row.ns_per_triangle), "–", "–"};
    if (row.peak) {
      cells[2] = significant(static_cast<double>(row.peak->added_bytes) / static_cast<double>(bench.triangles));
      cells[3] = bytes_text(row.peak->total_bytes);
    }
    for (const auto& ratio : row.ratios) cells.push_back(with_interval(ratio.second));
    table.add(std::move(cells));
  }
  return fmt::format("Building {}: {}\n\n{}\n", bench.scene, counted(bench.triangles, "triangle"), table.text());
}

Json build_json(const BuildBench& bench) {
  Json rows = Json::array();
  for (const BuildRow& row : bench.rows) {
    Json ratios = Json::object();
    for (const auto& ratio : row.ratios) ratios[ratio.first] = to_json(ratio.second);
    Json entry = {{"recipe", row.recipe}, {"ns_per_triangle", to_json(row.ns_per_triangle)}, {"ratios", ratios}};
    if (row.peak) {
      entry["peak_bytes_per_triangle"] =
          measured_once(static_cast<double>(row.peak->added_bytes) / static_cast<double>(bench.triangles));
      entry["peak_process_bytes"] = measured_once(static_cast<double>(row.peak->total_bytes));
    }
    rows.push_back(std::move(entry));
  }
  return {{"name", bench.scene}, {"triangles", bench.triangles}, {"rows", std::move(rows)}};
}

int run_bench(const BenchOptions& options) {
  const bool peers = !options.peer.empty() && has_embree();
  if (!options.peer.empty() && !peers) {
    complain("Embree was not found when boxwood was compiled, so there are no ratios to it; install libembree-dev");
  }
  if (peers && !options.huge) return report_peer(options);
  const std::vector<BuildBench> builds = bench_all_builds(options, peers);
  if (!options.common.json) {
    for (const BuildBench& bench : builds) print(build_text(bench));
    print("Ratios are speeds over the peer's in the same round: above 1, boxwood is faster.\n\n");
  }
  const std::vector<Comparison> tracing = bench_tracing(options);
  if (!options.common.json) {
    for (const Comparison& comparison : tracing) print(fmt::format("Tracing {}\n", comparison_text(comparison)));
    return exit_done;
  }
  Json document = {{"peer", peers ? Json(options.peer) : Json()}, {"build", Json::array()}, {"trace", Json::array()}};
  for (const BuildBench& bench : builds) document["build"].push_back(build_json(bench));
  for (const Comparison& comparison : tracing) document["trace"].push_back(to_json(comparison));
  print_json(document);
  return exit_done;
}

}  // namespace

void add_bench(CommandSet& commands) {
  const auto options = std::make_shared<BenchOptions>();
  Command command = commands.add("bench", "Measure the project's own speed: building, memory, tracing",
                                 [options] { return run_bench(*options); });
  command.choice("--peer", options->peer, {"embree"}, "NAME", "Library to measure against in the same run");
  command.text("--scenes", options->scenes, "DIR",
               "Folder of the scenes for --peer; without, BOXWOOD_SCENES in the environment, or generated ones");
  command.flag("--quick", options->quick, "Smaller scenes, fewer repeats");
  command.flag("--huge", options->huge, "Also build 28 million triangles");
  add_common(command, options->common);
}

}  // namespace boxwood::cli
