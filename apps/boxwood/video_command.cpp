// `boxwood video`: one picture per scene, all from one camera; the frames of an animated sequence (spec 003, 1.2).
#include <fmt/format.h>

#include <filesystem>
#include <memory>

#include "boxwood/error.h"
#include "command.h"
#include "console.h"
#include "exit_code.h"
#include "measure/clock.h"
#include "render/integrator.h"
#include "render/render.h"
#include "report/json.h"
#include "report/number_text.h"
#include "report/table.h"
#include "scene/cameras.h"
#include "workspace.h"

namespace boxwood::cli {
namespace {

struct VideoOptions {
  CommonOptions common;
  ViewOptions view;
  std::vector<std::string> scenes;
  std::string recipe = "default", integrator = "eyelight";
  std::string saved_view, folder = "video";
  std::uint32_t spp = 1;
  bool force = false;
};

struct Frame {
  std::string scene, file;
  double build_ms = 0, render_ms = 0;
};

/// The camera that the viewer saved, or the first scene's.
Camera camera_of(const VideoOptions& options, const Scene& first) {
  if (options.saved_view.empty()) return find_camera(first, options.view);
  const std::vector<Camera> cameras = read_cameras(options.saved_view);
  if (cameras.empty()) throw Error(fmt::format("'{}' holds no camera; save one in the viewer", options.saved_view));
  return cameras[0];
}

Frame render_frame(const Scene& scene, const Recipe& recipe, const Camera& camera, const VideoOptions& options,
                   const std::filesystem::path& file) {
  const Structure structure = build(scene, recipe, {.threads = options.common.threads});
  RenderSettings settings;
  settings.camera = camera;
  settings.width = options.view.width;
  settings.height = options.view.height;
  settings.spp = options.spp;
  settings.integrator = options.integrator;
  const double begin = now(Clock::wall);
  const RenderResult result = run_in_arena(options.common.threads, [&] { return render(scene, structure, settings); });
  const double render_ms = (now(Clock::wall) - begin) * 1000;
  write_image(file, result.image);
  return {scene.name, file.string(), structure.report().build_ms, render_ms};
}

int run_video(const VideoOptions& options) {
  const Recipe recipe = Recipe::parse(options.recipe);
  find_integrator(options.integrator);
  const auto file_of = [&](std::size_t i) {
    return std::filesystem::path(options.folder) / fmt::format("frame-{:05}.png", i);
  };
  std::filesystem::create_directories(options.folder);
  for (std::size_t i = 0; i < options.scenes.size(); ++i) check_can_write(file_of(i), options.force);
  Camera camera;
  std::vector<Frame> frames;
  for (std::size_t i = 0; i < options.scenes.size(); ++i) {
    check_interrupt();
    const Scene scene = load_scene(options.scenes[i]);
    for (const std::string& note : scene_notes(scene)) complain(note);
    if (i == 0) camera = camera_of(options, scene);
    frames.push_back(render_frame(scene, recipe, camera, options, file_of(i)));
  }
  if (options.common.json) {
    Json rows = Json::array();
    for (const Frame& frame : frames) {
      rows.push_back({{"scene", frame.scene},
                      {"file", frame.file},
                      {"build_ms", measured_once(frame.build_ms)},
                      {"render_ms", measured_once(frame.render_ms)}});
    }
    print_json({{"recipe", recipe.text()}, {"integrator", options.integrator}, {"frames", std::move(rows)}});
    return exit_done;
  }
  Table table({{"scene", Align::left}, {"build ms"}, {"render ms"}, {"picture", Align::left}});
  for (const Frame& frame : frames) {
    table.add({frame.scene, significant(frame.build_ms), significant(frame.render_ms), frame.file});
  }
  print(table.text());
  return exit_done;
}

}  // namespace

void add_video(CommandSet& commands) {
  const auto options = std::make_shared<VideoOptions>();
  Command command = commands.add("video", "Render one picture per scene, all from one camera",
                                 [options] { return run_video(*options); });
  add_scenes(command, options->scenes);
  add_recipe(command, options->recipe);
  command.text("--integrator", options->integrator, "NAME", "As in 'boxwood render'");
  add_view(command, options->view);
  command.text("--view", options->saved_view, "FILE", "A camera that the viewer saved, for all scenes",
               "first scene's");
  command.integer("--spp", options->spp, 1, 1u << 20, "Samples per pixel");
  command.text("-o,--output", options->folder, "FOLDER", "Where frame-00000.png and so on are written");
  command.flag("--force", options->force, "Replace pictures that are there");
  add_common(command, options->common);
}

}  // namespace boxwood::cli
