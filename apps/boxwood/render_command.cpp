// `boxwood render`: one picture of one scene, and how fast its rays were traced.
#include <fmt/format.h>

#include <charconv>
#include <cmath>
#include <memory>
#include <optional>

#include "boxwood/saved.h"
#include "command.h"
#include "console.h"
#include "exit_code.h"
#include "expected_view.h"
#include "measure/clock.h"
#include "options/options.h"
#include "render/integrator.h"
#include "render/render.h"
#include "render/tone_map.h"
#include "report/json.h"
#include "report/number_text.h"
#include "report/progress_bar.h"
#include "report/table.h"
#include "scene/cameras.h"
#include "workspace.h"

namespace boxwood::cli {
namespace {

struct RenderOptions {
  CommonOptions common;
  ViewOptions view;
  std::string scene;
  std::string recipe = "default";
  std::string saved;  ///< file of a structure; empty: it is built by the recipe
  std::string integrator = "eyelight";
  std::uint32_t spp = 1;
  std::uint32_t heatmap_scale = 0;
  std::uint32_t depth = 8;
  std::string lights = "scene", secondary = "queued";
  std::optional<float> exposure;  ///< stops; none: by the picture's own brightness
  std::string output = "out.png";
  std::string cameras;  ///< file; one picture for each of its cameras
  bool force = false;
};

struct Rendering {
  ViewOptions view;  ///< as it was rendered
  RenderResult result;
  double seconds = 0;
};

/// A camera and where its picture goes.
struct Shot {
  Camera camera;
  std::filesystem::path file;
};

/// One picture, or one for each camera of a file, called after it.
std::vector<Shot> plan_shots(const RenderOptions& options) {
  const std::filesystem::path output = options.output;
  std::vector<Shot> shots;
  if (options.cameras.empty()) {
    shots.emplace_back().file = output;
    return shots;
  }
  for (Camera& camera : read_cameras(options.cameras)) {
    const std::string name = fmt::format("{}-{}{}", output.stem().string(), camera.name, output.extension().string());
    shots.push_back({std::move(camera), output.parent_path() / name});
  }
  if (shots.empty()) throw UsageError(fmt::format("{} has no cameras; nothing would be rendered", options.cameras));
  return shots;
}

/// A camera whose file asks for a size gets it, unless another was asked for.
ViewOptions sized_for(const Camera& camera, ViewOptions view) {
  if (view.sized || camera.width == 0) return view;
  view.width = camera.width;
  view.height = camera.height;
  return view;
}

Rendering render_timed(const Scene& scene, const Structure& structure, const RenderOptions& options,
                       const Camera& camera) {
  Rendering rendering;
  rendering.view = sized_for(camera, options.view);
  RenderSettings settings;
  settings.camera = camera;
  settings.width = rendering.view.width;
  settings.height = rendering.view.height;
  settings.spp = options.spp;
  settings.depth = options.depth;
  settings.lights = options.lights;
  settings.secondary = options.secondary == "immediate" ? SecondaryRays::immediate : SecondaryRays::queued;
  settings.integrator = options.integrator;
  settings.heatmap_scale = static_cast<float>(options.heatmap_scale);
  ProgressBar bar(stop_requested());
  const double begin = now(Clock::wall);
  rendering.result = run_in_arena(options.common.threads, [&] { return render(scene, structure, settings, &bar); });
  rendering.seconds = now(Clock::wall) - begin;
  return rendering;
}

std::string rays_table(const RenderResult& result) {
  Table table({{"rays", Align::left}, {"traced"}, {"hit"}, {"Mrays/s per thread"}});
  for (const RayKindReport& report : result.ray_kinds) {
    const double share =
        report.rays == 0 ? 0 : 100 * static_cast<double>(report.hits) / static_cast<double>(report.rays);
    table.add({report.kind, grouped(report.rays), fmt::format("{:.1f} %", share), significant(mrays_per_s(report))});
  }
  return table.text();
}

Json rendering_json(const Scene& scene, const Structure& structure, const RenderOptions& options, const Shot& shot,
                    const Rendering& rendering) {
  return {{"scene", scene.name},
          {"camera", shot.camera.name},
          {"triangles", scene.placed_triangles()},
          {"recipe", structure.recipe().text()},
          {"integrator", options.integrator},
          {"width", rendering.view.width},
          {"height", rendering.view.height},
          {"spp", options.spp},
          {"depth", options.depth},
          {"lights", options.lights},
          {"secondary", options.secondary},
          {"build_ms", measured_once(structure.report().build_ms)},
          {"render_ms", measured_once(rendering.seconds * 1000)},
          {"rays", to_json(rendering.result.ray_kinds)},
          {"queries", totals_by_query(rendering.result.ray_kinds)},
          {"heatmap_scale", rendering.result.heatmap_scale},
          {"file", shot.file.string()},
          {"notes", to_json(scene.notes)}};
}

std::string rendering_text(const Shot& shot, const Rendering& rendering) {
  std::string text = fmt::format("\n{}\nRendered in {}; the picture is {}\n", rays_table(rendering.result),
                                 duration_text(rendering.seconds), shot.file.string());
  if (rendering.result.heatmap_scale > 0) {
    text += fmt::format("Red: primitive tests per ray, green: inner nodes visited; full brightness is {}\n",
                        significant(rendering.result.heatmap_scale));
  }
  return text;
}

/// Pictures of radiance get their tones mapped, except in files that can hold them as they are.
void write_picture(const std::filesystem::path& file, const Integrator& integrator, const RenderOptions& options,
                   const Image& image) {
  const bool mapped = integrator.radiance && !keeps_radiance(file);
  write_image(file, mapped ? map_tones(image, options.exposure) : image);
}

std::optional<float> parse_exposure(const std::string& text) {
  double stops = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), stops);
  if (error != std::errc{} || end != text.data() + text.size() || !(std::fabs(stops) <= 50)) {
    throw UsageError(fmt::format("takes a number of stops from -50 to 50, not '{}'", text));
  }
  return static_cast<float>(stops);
}

/// Built for the first picture of a path, or loaded.
Structure structure_of(const Scene& scene, const Recipe& recipe, const Camera& camera, const RenderOptions& options) {
  if (!options.saved.empty()) {
    Structure structure = load_structure(options.saved);
    check_fits(structure, scene);
    return structure;
  }
  std::optional<ExpectedUse> use;
  if (needs_use(recipe)) use = expected_view(scene, camera, options.view, options.common.threads);
  return build(scene, recipe, {.threads = options.common.threads, .use = pointer_to(use)});
}

int run_render(const RenderOptions& options) {
  const Recipe recipe = Recipe::parse(options.recipe);
  const Integrator& integrator = find_integrator(options.integrator);
  std::vector<Shot> shots = plan_shots(options);
  for (const Shot& shot : shots) check_can_write_image(shot.file, options.force);
  const Scene scene = load_scene(options.scene);
  if (options.cameras.empty()) shots.front().camera = find_camera(scene, options.view);
  for (const std::string& note : scene_notes(scene)) complain(note);
  check_interrupt();
  const Structure structure = structure_of(scene, recipe, shots.front().camera, options);
  Json documents = Json::array();
  if (!options.common.json) {
    print(fmt::format("{}: {}, built in {} by {}\n", scene.name, counted(scene.placed_triangles(), "triangle"),
                      duration_text(structure.report().build_ms / 1000), structure.recipe().text()));
  }
  for (const Shot& shot : shots) {
    check_interrupt();
    const Rendering rendering = render_timed(scene, structure, options, shot.camera);
    write_picture(shot.file, integrator, options, rendering.result.image);
    if (options.common.json) {
      documents.push_back(rendering_json(scene, structure, options, shot, rendering));
    } else {
      print(rendering_text(shot, rendering));
    }
  }
  if (options.common.json) print_json(options.cameras.empty() ? documents.front() : documents);
  return exit_done;
}

}  // namespace

void add_render(CommandSet& commands) {
  const auto options = std::make_shared<RenderOptions>();
  Command command = commands.add("render", "Render a scene", [options] { return run_render(*options); });
  add_scene(command, options->scene);
  add_recipe(command, options->recipe);
  command.text("--structure", options->saved, "FILE", "Trace a structure saved by 'boxwood build' instead of building",
               "none");
  command.conflict("--structure", "--recipe");
  std::vector<std::string> names;
  for (const Integrator& integrator : integrators()) names.emplace_back(integrator.name);
  command.text("--integrator", options->integrator, "NAME", "One of " + option_text::join(names, ", "));
  add_view(command, options->view);
  command.text("--cameras", options->cameras, "FILE",
               "Render from each camera of this file (see boxwood cameras); pictures are called OUTPUT-CAMERA", "none");
  command.conflict("--cameras", "--camera");
  command.integer("--spp", options->spp, 1, 1u << 20, "Samples per pixel");
  command.integer("--heatmap-scale", options->heatmap_scale, 0, 1u << 20,
                  "Tests per ray at full brightness of a heat map, so that several compare; 0: the most of any pixel");
  command.integer("--depth", options->depth, 0, 1000, "Most bounces of a path (integrators path and whitted)");
  std::vector<std::string> lights;
  for (const LightSetting& setting : light_settings()) lights.emplace_back(setting.name);
  command.choice("--lights", options->lights, lights, "NAME", "What lights the scene (integrator whitted)");
  command.choice("--secondary", options->secondary, {"queued", "immediate"}, "WHEN",
                 "Trace reflected, refracted and shadow rays all together or at once (integrator whitted)");
  command.parsed(
      "--exposure", [options](const std::string& text) { options->exposure = parse_exposure(text); }, "STOPS",
      "Brightness of a .png (integrator path); 0 shows radiance as it is, 1 twice as bright", "by the picture");
  command.text("-o,--output", options->output, "FILE", "Picture to write, .png or .exr");
  command.flag("--force", options->force, "Replace the picture if there is one");
  add_common(command, options->common);
}

}  // namespace boxwood::cli
