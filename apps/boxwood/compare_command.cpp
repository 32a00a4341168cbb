// `boxwood compare`: the main job. Which recipe traces which rays how fast, and at what price.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <memory>

#include "boxwood/ray_set.h"
#include "command.h"
#include "comparison_images.h"
#include "comparison_metrics.h"
#include "console.h"
#include "exit_code.h"
#include "expected_view.h"
#include "measure/compare.h"
#include "options/options.h"
#include "options/suggest.h"
#include "recipe/stage.h"
#include "report/comparison_text.h"
#include "report/json.h"
#include "report/progress_bar.h"
#include "workspace.h"

namespace boxwood::cli {
namespace {

struct CompareOptions {
  CommonOptions common{.threads = 1};
  ViewOptions view;
  std::vector<std::string> scenes;
  std::vector<std::string> recipes;  ///< empty: a spread of everything there is
  std::vector<std::string> saved;    ///< files of structures
  std::vector<std::string> rays;     ///< kinds; empty: primary, shadow, ao, diffuse
  std::uint32_t repeats = 11;
  std::string save_rays, load_rays;  ///< files
  std::string images;                ///< folder
  bool metrics = false;
  bool force = false;
};

/// Builders on one layout, orders, widths without and with SIMD, then the presets; every peer follows. The first is
/// what the others are held against.
constexpr std::array default_recipes = {
    "median > binary",
    "middle > binary",
    "equal > binary",
    "sweep > binary",
    "binned > binary",
    "binned > binary > trace(order=axis)",
    "binned > binary > trace(order=none)",
    "median(k=4) > wide(4)",
    "binned > wide(4) > trace(simd=off)",
    "binned > wide(4)",
    "binned > wide(8)",
    "fast",
    "default",
    "best",
};

std::vector<Recipe> recipes_of(const CompareOptions& options) {
  if (!options.recipes.empty()) return parse_recipes(options.recipes);
  std::vector<std::string> texts(default_recipes.begin(), default_recipes.end());
  for (const Stage& stage : stages()) {
    if (stage.kind == StageKind::peer) texts.push_back(stage.name);
  }
  return parse_recipes(texts);
}

void check_request(const CompareOptions& options) {
  const bool many = options.scenes.size() > 1;
  if (many && !options.save_rays.empty()) throw UsageError("--save-rays takes the rays of one scene; name only one");
  if (many && !options.saved.empty()) throw UsageError("--structure is a structure of one scene; name only one");
  if (!options.saved.empty() && options.metrics) {
    throw UsageError("--metrics judges trees, which saved structures do not have; leave --structure or it out");
  }
  if (many && !options.load_rays.empty()) throw UsageError("--load-rays has the rays of one scene; name only one");
  if (!options.load_rays.empty() && !options.rays.empty()) {
    throw UsageError("--load-rays brings its own rays; leave --rays out");
  }
  for (const std::string& kind : options.rays) {
    if (std::ranges::find(ray_kinds(), kind) != ray_kinds().end()) continue;
    const std::vector<std::string> kinds(ray_kinds().begin(), ray_kinds().end());
    throw UsageError(fmt::format("--rays knows no kind '{}'; {}", kind, suggest(kind, kinds)));
  }
  if (!options.save_rays.empty()) check_can_write(options.save_rays, options.force);
}

std::vector<RaySet> ray_sets_of(const Scene& scene, const CompareOptions& options) {
  if (!options.load_rays.empty()) return load_ray_sets(options.load_rays);
  RaySetSettings settings;
  settings.camera = find_camera(scene, options.view);
  settings.width = options.view.width;
  settings.height = options.view.height;
  const std::vector<std::string> usual = {"primary", "shadow", "ao", "diffuse"};
  const Structure structure = build(scene, "default", {.threads = options.common.threads});
  return run_in_arena(options.common.threads, [&] {
    return make_ray_sets(scene, structure, settings, options.rays.empty() ? usual : options.rays);
  });
}

/// What is there to build for: nothing when no one asks.
std::optional<ExpectedUse> use_of(const Scene& scene, const std::vector<Recipe>& recipes,
                                  const std::vector<RaySet>& ray_sets, const CompareOptions& options) {
  if (!options.metrics && std::ranges::none_of(recipes, needs_use)) return {};
  if (options.load_rays.empty()) return expected_view(scene, options.view, options.common.threads);
  return expected_rays(scene, ray_sets, options.view, options.common.threads);
}

struct SceneComparison {
  Comparison comparison;
  std::optional<ComparisonMetrics> metrics;
};

SceneComparison compare_scene(const Scene& scene, const std::vector<Recipe>& recipes, const CompareOptions& options) {
  ProgressBar bar(stop_requested());
  bar.report(0, "tracing the rays to compare with");
  const std::vector<RaySet> ray_sets = ray_sets_of(scene, options);
  if (!options.save_rays.empty()) save_ray_sets(options.save_rays, ray_sets);
  check_interrupt();
  const std::optional<ExpectedUse> use = use_of(scene, recipes, ray_sets, options);
  CompareSettings settings;
  settings.repeats = options.repeats;
  settings.threads = options.common.threads;
  settings.use = use ? &*use : nullptr;
  settings.saved.assign(options.saved.begin(), options.saved.end());
  SceneComparison result{compare(scene, recipes, ray_sets, settings, &bar), {}};
  if (options.metrics) {
    result.metrics = run_in_arena(options.common.threads,
                                  [&] { return comparison_metrics(scene, recipes, *use, result.comparison); });
  }
  return result;
}

std::string images_text(const ComparisonImages& images) {
  std::string out = fmt::format("Rendering: {}\n", images.rendering);
  for (const HeatMap& map : images.heat_maps) out += fmt::format("Heat map:  {}  {}\n", map.file, map.recipe);
  return fmt::format("{}Red: primitive tests per ray, green: inner nodes visited; full brightness is {:.0f} in all.\n",
                     out, images.scale);
}

Json images_json(const ComparisonImages& images) {
  Json maps = Json::array();
  for (const HeatMap& map : images.heat_maps) maps.push_back({{"recipe", map.recipe}, {"file", map.file}});
  return {{"rendering", images.rendering},
          {"heat_maps", std::move(maps)},
          {"tests_per_ray_at_full_brightness", images.scale}};
}

/// Peers may see things a little differently; ours may not.
bool own_recipes_agree(const Comparison& comparison) {
  return std::ranges::all_of(comparison.rows, [](const RecipeRow& row) {
    return row.peer || std::ranges::all_of(row.rays, [](const RayKindRow& kind) { return kind.mismatches == 0; });
  });
}

/// Text is printed scene by scene, so that a reader need not wait for the last; JSON is returned.
Json compare_and_show(const std::string& path, const std::vector<Recipe>& recipes, const CompareOptions& options,
                      bool& agree) {
  const Scene scene = load_scene(path);
  const std::vector<std::string> notes = scene_notes(scene);
  for (const std::string& note : notes) complain(note);
  if (options.metrics) check_metrics(scene);
  if (!options.images.empty()) check_images(options.images, scene, recipes, options.force);
  const auto [comparison, metrics] = compare_scene(scene, recipes, options);
  agree = agree && own_recipes_agree(comparison);
  Json json = to_json(comparison);
  if (!options.common.json) print(fmt::format("{}\n", comparison_text(comparison)));
  if (metrics) {
    json["metrics"] = metrics->json;
    if (!options.common.json) print(fmt::format("{}\n", metrics->text));
  }
  if (!options.images.empty()) {
    const ComparisonImages images = write_images(options.images, scene, recipes, options.view, options.common.threads);
    json["images"] = images_json(images);
    if (!options.common.json) print(fmt::format("{}\n", images_text(images)));
  }
  return json;
}

int run_compare(const CompareOptions& options) {
  check_request(options);
  const std::vector<Recipe> recipes = recipes_of(options);
  bool agree = true;
  Json scenes = Json::array();
  for (const std::string& path : options.scenes) scenes.push_back(compare_and_show(path, recipes, options, agree));
  if (options.common.json) print_json(Json{{"scenes", std::move(scenes)}});
  if (!options.common.json && !options.save_rays.empty()) print(fmt::format("The rays are in {}\n", options.save_rays));
  return agree ? exit_done : exit_failed;
}

}  // namespace

void add_compare(CommandSet& commands) {
  const auto options = std::make_shared<CompareOptions>();
  Command command = commands.add("compare", "Find out which recipe is faster on which rays, by how much and why",
                                 [options] { return run_compare(*options); });
  add_scenes(command, options->scenes);
  add_recipes(command, options->recipes, "A contestant; say it once for each (none: a spread of everything there is)");
  const std::vector<std::string> kinds(ray_kinds().begin(), ray_kinds().end());
  command.repeated(
      "--structure", options->saved, "FILE",
      "A structure saved by 'boxwood build' as a further contestant; its build time is that of loading it");
  command.list("--rays", options->rays, "KINDS", "Comma-separated ray kinds: " + option_text::join(kinds, ", "),
               "primary,shadow,ao,diffuse");
  command.integer("--repeat", options->repeats, 1, 10000, "Timed passes over each ray set");
  add_view(command, options->view);
  command.text("--save-rays", options->save_rays, "FILE", "Write the rays that were traced to a file");
  command.text("--load-rays", options->load_rays, "FILE", "Trace the rays of such a file");
  command.text("--images", options->images, "DIR", "Write a rendering and heat maps into a folder");
  command.flag("--metrics", options->metrics,
               "Also judge every tree by metrics, and the metrics by the times measured; builds each once more");
  command.flag("--force", options->force, "Replace files that exist");
  add_common(command, options->common);
}

}  // namespace boxwood::cli
