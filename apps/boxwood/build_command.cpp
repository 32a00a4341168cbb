// `boxwood build`: builds a structure and keeps it in a file, to be mapped instead of built the next time.
#include <fmt/format.h>

#include <memory>
#include <optional>

#include "boxwood/saved.h"
#include "command.h"
#include "console.h"
#include "exit_code.h"
#include "expected_view.h"
#include "measure/clock.h"
#include "report/json.h"
#include "report/number_text.h"
#include "report/table.h"
#include "workspace.h"

namespace boxwood::cli {
namespace {

struct BuildCommandOptions {
  CommonOptions common;
  ViewOptions view;
  std::string scene;
  std::string recipe = "default";
  std::string output;
  bool force = false;
};

/// What the file costs, measured on the file that was just written and lies in the system's cache.
struct FileCosts {
  std::uint64_t bytes = 0;
  double save_ms = 0, load_ms = 0, load_unverified_ms = 0;
};

template <class Work>
double milliseconds(const Work& work) {
  const double begin = now(Clock::wall);
  work();
  return (now(Clock::wall) - begin) * 1000;
}

/// Loads the file again: what was written can be read, or the command fails.
FileCosts save_and_check(const Structure& structure, const BuildCommandOptions& options) {
  const std::filesystem::path file = options.output;
  FileCosts costs;
  costs.save_ms = milliseconds([&] { save(structure, file); });
  run_in_arena(options.common.threads, [&] {
    costs.load_ms = milliseconds([&] { load_structure(file); });
    costs.load_unverified_ms = milliseconds([&] { load_structure(file, {.verification = Verification::header}); });
  });
  costs.bytes = std::filesystem::file_size(file);
  return costs;
}

std::string saved_text(const Scene& scene, const Structure& structure, const FileCosts& costs,
                       const std::string& file) {
  const BuildReport& report = structure.report();
  Table table({{"structure", Align::left}, {""}});
  table.add({"build time", duration_text(report.build_ms / 1000)});
  table.add({"triangles in it", grouped(report.primitives)});
  table.add({"memory of the layout", bytes_text(report.bytes)});
  table.add({"file", bytes_text(costs.bytes)});
  table.add({"time to save", duration_text(costs.save_ms / 1000)});
  table.add({"time to load and verify", duration_text(costs.load_ms / 1000)});
  table.add({"time to load unverified", duration_text(costs.load_unverified_ms / 1000)});
  return fmt::format("{}: {}\n{}\n\n{}\nThe structure is in {}; 'boxwood compare SCENE --structure {}' traces it.\n",
                     scene.name, counted(scene.placed_triangles(), "triangle"), structure.recipe().text(), table.text(),
                     file, file);
}

Json saved_json(const Scene& scene, const Structure& structure, const FileCosts& costs, const std::string& file) {
  const BuildReport& report = structure.report();
  return {{"scene", scene.name},
          {"triangles", scene.placed_triangles()},
          {"recipe", structure.recipe().text()},
          {"build_ms", measured_once(report.build_ms)},
          {"bytes", report.bytes},
          {"file", file},
          {"file_bytes", costs.bytes},
          {"save_ms", measured_once(costs.save_ms)},
          {"load_ms", measured_once(costs.load_ms)},
          {"load_unverified_ms", measured_once(costs.load_unverified_ms)}};
}

int run_build(const BuildCommandOptions& options) {
  const Recipe recipe = Recipe::parse(options.recipe);
  if (options.output.empty()) throw UsageError("build: name the file to write with -o FILE, as in -o scene.boxwood");
  check_can_write(options.output, options.force);
  const Scene scene = load_scene(options.scene);
  for (const std::string& note : scene_notes(scene)) complain(note);
  check_interrupt();
  const std::optional<ExpectedUse> use =
      expected_view(scene, std::span(&recipe, 1), options.view, options.common.threads);
  const Structure structure = build(scene, recipe, {.threads = options.common.threads, .use = pointer_to(use)});
  check_interrupt();
  const FileCosts costs = save_and_check(structure, options);
  if (options.common.json) {
    print_json(saved_json(scene, structure, costs, options.output));
  } else {
    print(saved_text(scene, structure, costs, options.output));
  }
  return exit_done;
}

}  // namespace

void add_build(CommandSet& commands) {
  const auto options = std::make_shared<BuildCommandOptions>();
  Command command = commands.add("build", "Build a structure and keep it in a file that loads in milliseconds",
                                 [options] { return run_build(*options); });
  add_scene(command, options->scene);
  add_recipe(command, options->recipe);
  command.text("-o,--output", options->output, "FILE", "File to write, such as scene.boxwood", "none");
  add_view(command, options->view);
  command.flag("--force", options->force, "Replace the file if there is one");
  add_common(command, options->common);
}

}  // namespace boxwood::cli
