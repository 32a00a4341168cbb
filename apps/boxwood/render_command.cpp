// `boxwood render`: one picture of one scene, and how fast its rays were traced.
#include <fmt/format.h>

#include <memory>

#include "command.h"
#include "console.h"
#include "exit_code.h"
#include "measure/clock.h"
#include "options/options.h"
#include "render/integrator.h"
#include "render/render.h"
#include "report/json.h"
#include "report/number_text.h"
#include "report/progress_bar.h"
#include "report/table.h"
#include "workspace.h"

namespace boxwood::cli {
namespace {

struct RenderOptions {
  CommonOptions common;
  ViewOptions view;
  std::string scene;
  std::string recipe = "default";
  std::string integrator = "eyelight";
  std::uint32_t spp = 1;
  std::string output = "out.png";
  bool force = false;
};

struct Rendering {
  RenderResult result;
  double seconds = 0;
};

Rendering render_timed(const Scene& scene, const Structure& structure, const RenderOptions& options) {
  RenderSettings settings;
  settings.camera = find_camera(scene, options.view);
  settings.width = options.view.width;
  settings.height = options.view.height;
  settings.spp = options.spp;
  settings.integrator = options.integrator;
  ProgressBar bar(stop_requested());
  const double begin = now(Clock::wall);
  Rendering rendering;
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

Json rendering_json(const Scene& scene, const Structure& structure, const RenderOptions& options,
                    const Rendering& rendering) {
  return {{"scene", scene.name},
          {"triangles", scene.placed_triangles()},
          {"recipe", structure.recipe().text()},
          {"integrator", options.integrator},
          {"width", options.view.width},
          {"height", options.view.height},
          {"spp", options.spp},
          {"build_ms", measured_once(structure.report().build_ms)},
          {"render_ms", measured_once(rendering.seconds * 1000)},
          {"rays", to_json(rendering.result.ray_kinds)},
          {"heatmap_scale", rendering.result.heatmap_scale},
          {"file", options.output},
          {"notes", to_json(scene.notes)}};
}

int run_render(const RenderOptions& options) {
  const Recipe recipe = Recipe::parse(options.recipe);
  find_integrator(options.integrator);
  check_can_write_image(options.output, options.force);
  const Scene scene = load_scene(options.scene);
  find_camera(scene, options.view);
  for (const std::string& note : scene_notes(scene)) complain(note);
  check_interrupt();
  const Structure structure = build(scene, recipe, {.threads = options.common.threads});
  check_interrupt();
  const Rendering rendering = render_timed(scene, structure, options);
  write_image(options.output, rendering.result.image);
  if (options.common.json) {
    print_json(rendering_json(scene, structure, options, rendering));
    return exit_done;
  }
  print(fmt::format("{}: {}, built in {} by {}\n\n{}\nRendered in {}; the picture is {}\n", scene.name,
                    counted(scene.placed_triangles(), "triangle"), duration_text(structure.report().build_ms / 1000),
                    recipe.text(), rays_table(rendering.result), duration_text(rendering.seconds), options.output));
  if (rendering.result.heatmap_scale > 0) {
    print(fmt::format("Red: primitive tests per ray, green: inner nodes visited; full brightness is {}\n",
                      significant(rendering.result.heatmap_scale)));
  }
  return exit_done;
}

}  // namespace

void add_render(CommandSet& commands) {
  const auto options = std::make_shared<RenderOptions>();
  Command command = commands.add("render", "Render a scene", [options] { return run_render(*options); });
  add_scene(command, options->scene);
  add_recipe(command, options->recipe);
  std::vector<std::string> names;
  for (const Integrator& integrator : integrators()) names.emplace_back(integrator.name);
  command.text("--integrator", options->integrator, "NAME", "One of " + option_text::join(names, ", "));
  add_view(command, options->view);
  command.integer("--spp", options->spp, 1, 1u << 20, "Samples per pixel");
  command.text("-o,--output", options->output, "FILE", "Picture to write, .png or .exr");
  command.flag("--force", options->force, "Replace the picture if there is one");
  add_common(command, options->common);
}

}  // namespace boxwood::cli
