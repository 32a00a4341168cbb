// `boxwood test`: the test mode of the single slab study (spec 003, 1.2 and 1.10): for each scene every structure of
// the plan in its order, a number of equal frames each, reported to the console and to a file.
#include <fmt/format.h>

#include <memory>

#include "boxwood/error.h"
#include "command.h"
#include "console.h"
#include "exit_code.h"
#include "files/output_file.h"
#include "frame_test.h"
#include "render/integrator.h"
#include "report/json.h"
#include "scene/cameras.h"
#include "workspace.h"

namespace boxwood::cli {
namespace {

struct TestOptions {
  CommonOptions common{.threads = 1};
  ViewOptions view{.camera = {}, .width = 640, .height = 480};
  std::vector<std::string> scenes, recipes;
  std::string integrator = "eyelight", saved_view, report;
  std::uint32_t frames = 30;
  bool force = false;
};

Json times_json(const FrameTimes& times) {
  return {{"first", times.first},
          {"last", times.last},
          {"minimum", times.least},
          {"average", times.mean},
          {"maximum", times.most}};
}

Json test_json(const FrameTest& test) {
  return {{"recipe", test.recipe},
          {"scene", test.scene},
          {"triangles", test.triangles},
          {"width", test.width},
          {"height", test.height},
          {"threads", test.threads},
          {"frames", test.frames},
          {"build_s", test.build_seconds},
          {"tree_height", test.tree_height},
          {"inner_nodes", test.inner_nodes},
          {"leaf_nodes", test.leaf_nodes},
          {"node_bytes", test.node_bytes},
          {"surface_ratio", test.surface_ratio},
          {"walk", test.walk},
          {"node_tests_per_ray", test.node_tests},
          {"primitive_tests_per_ray", test.triangle_tests},
          {"traversal_s", times_json(test.traversal)},
          {"raytrace_s", times_json(test.raytrace)}};
}

RenderSettings settings_of(const TestOptions& options, const Scene& scene) {
  RenderSettings settings;
  settings.camera = find_camera(scene, options.view);
  if (!options.saved_view.empty()) {
    const std::vector<Camera> cameras = read_cameras(options.saved_view);
    if (cameras.empty()) throw Error(fmt::format("'{}' holds no camera; save one in the viewer", options.saved_view));
    settings.camera = cameras[0];
  }
  settings.width = options.view.width;
  settings.height = options.view.height;
  settings.integrator = options.integrator;
  return settings;
}

int run_test(const TestOptions& options) {
  std::vector<std::string> texts = options.recipes;
  if (texts.empty())
    texts = {"middle(plane=box) > slab(index=64, packet=4)", "middle(plane=box) > binary-split(index=64, packet=4)"};
  const std::vector<Recipe> recipes = parse_recipes(texts);
  find_integrator(options.integrator);
  if (!options.report.empty()) check_can_write(options.report, options.force);
  std::string report;
  Json tests = Json::array();
  for (const std::string& name : options.scenes) {
    const Scene scene = load_scene(name);
    for (const std::string& note : scene_notes(scene)) complain(note);
    const RenderSettings settings = settings_of(options, scene);
    for (const Recipe& recipe : recipes) {
      check_interrupt();
      const FrameTest test = run_in_arena(options.common.threads, [&] {
        return test_frames(scene, recipe, settings, options.frames, options.common.threads);
      });
      report += report_text(test) + "\n";
      tests.push_back(test_json(test));
      if (!options.common.json) print(report_text(test) + "\n");
    }
  }
  if (!options.report.empty()) {
    OutputFile file(options.report);
    file.write(report);
    file.commit();
  }
  if (options.common.json) print_json({{"tests", std::move(tests)}});
  return exit_done;
}

}  // namespace

void add_test(CommandSet& commands) {
  const auto options = std::make_shared<TestOptions>();
  Command command = commands.add("test", "Time equal frames of structures on scenes, as the single slab study did",
                                 [options] { return run_test(*options); });
  add_scenes(command, options->scenes);
  add_recipes(command, options->recipes,
              "Structures in the order of the plan, repeats allowed; default: slab and its twin");
  command.integer("--frames", options->frames, 1, 1u << 20, "Frames of each");
  command.text("--integrator", options->integrator, "NAME", "Shading of the whole frames, as in 'boxwood render'");
  add_view(command, options->view);
  command.text("--view", options->saved_view, "FILE", "A camera that the viewer saved", "the scene's");
  command.text("-o,--output", options->report, "FILE", "Where the report is written as well", "nowhere");
  command.flag("--force", options->force, "Replace the report if there is one");
  add_common(command, options->common);
}

}  // namespace boxwood::cli
