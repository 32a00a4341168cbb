// `boxwood cameras`: from where a scene can be looked at, and paths through it that `render --cameras` follows.
#include <fmt/format.h>

#include <memory>

#include "command.h"
#include "console.h"
#include "exit_code.h"
#include "report/json.h"
#include "report/number_text.h"
#include "report/table.h"
#include "scene/cameras.h"
#include "shared_options.h"
#include "workspace.h"

namespace boxwood::cli {
namespace {

struct CamerasOptions {
  std::string scene;
  std::string path = "none";
  std::uint32_t frames = 36;
  std::string output;
  bool force = false;
  bool json = false;
};

std::vector<Camera> chosen_cameras(const Scene& scene, const CamerasOptions& options) {
  if (options.path == "orbit") return orbit_path(scene.bounds(), options.frames);
  if (options.path == "none") return scene.cameras;
  // The last camera is the automatic one, which is no part of a walk through the scene.
  const std::span<const Camera> key_frames = std::span(scene.cameras).first(scene.cameras.size() - 1);
  if (key_frames.size() < 2) {
    throw UsageError(fmt::format("{} has {} of its own; a spline needs at least two key frames, so write them to {}",
                                 scene.name, counted(key_frames.size(), "camera"), "SCENE.cameras.json"));
  }
  return spline_path(key_frames, options.frames);
}

std::string vector_text(const Vec3& v) { return fmt::format("{:.4g} {:.4g} {:.4g}", v.x, v.y, v.z); }

std::string cameras_table(std::span<const Camera> cameras) {
  Table table({{"camera", Align::left}, {"eye"}, {"direction"}, {"up"}, {"fov"}});
  for (const Camera& camera : cameras) {
    table.add({camera.name, vector_text(camera.eye), vector_text(camera.direction), vector_text(camera.up),
               fmt::format("{:.4g}", camera.fov)});
  }
  return table.text();
}

int run_cameras(const CamerasOptions& options) {
  if (!options.output.empty()) check_can_write(options.output, options.force);
  const Scene scene = load_scene(options.scene);
  const std::vector<Camera> cameras = chosen_cameras(scene, options);
  if (!options.output.empty()) write_cameras(options.output, cameras);
  if (options.json) {
    Json list = Json::array();
    for (const Camera& camera : cameras) list.push_back(to_json(camera));
    print_json({{"scene", scene.name}, {"cameras", list}});
    return exit_done;
  }
  print(cameras_table(cameras));
  if (!options.output.empty()) print(fmt::format("\nWritten to {}\n", options.output));
  return exit_done;
}

}  // namespace

void add_cameras(CommandSet& commands) {
  const auto options = std::make_shared<CamerasOptions>();
  Command command = commands.add("cameras", "List a scene's cameras, or make a path of them",
                                 [options] { return run_cameras(*options); });
  add_scene(command, options->scene);
  command.choice("--path", options->path, {"none", "orbit", "spline"}, "NAME",
                 "Around the scene, or through its own cameras");
  command.integer("--frames", options->frames, 1, 100000, "Cameras of the path");
  command.text("-o,--output", options->output, "FILE", "Write them, to be used by render --cameras", "not written");
  command.flag("--force", options->force, "Replace the file if there is one");
  add_json(command, options->json);
}

}  // namespace boxwood::cli
