// boxwood-viewer: fly through a scene while acceleration structures are switched under it. `boxwood view` starts it.
#include <fmt/format.h>

#include <CLI/CLI.hpp>

#include "app.h"
#include "boxwood/error.h"
#include "boxwood/recipe.h"
#include "render/integrator.h"
#include "transfer_times.h"

namespace boxwood::viewer {
namespace {

constexpr int exit_failed = 1, exit_usage = 2;

struct CommandLine {
  AppOptions app;
  std::vector<std::string> scenes;
  std::string size = "1280x720";
  bool time_transfers = false;
};

void parse_size(const std::string& text, AppOptions& options) {
  int width = 0, height = 0;
  char rest = 0;
  const bool good = std::sscanf(text.c_str(), "%dx%d%c", &width, &height, &rest) == 2;
  if (!good || width < 64 || height < 64 || width > 16384 || height > 16384) {
    throw UsageError(fmt::format("--size takes WIDTHxHEIGHT in pixels, 64 to 16384 each, not '{}'", text));
  }
  options.width = width, options.height = height;
}

void run(CommandLine& line) {
  parse_size(line.size, line.app);
  if (line.time_transfers) {
    fmt::print("{}\n", transfer_times(line.app.width, line.app.height));
    return;
  }
  if (line.scenes.empty()) throw UsageError("SCENE is missing: a file or generate:NAME(…)");
  if (line.app.recipes.empty()) line.app.recipes = {"default"};
  for (const std::string& recipe : line.app.recipes) Recipe::parse(recipe);
  find_integrator(line.app.integrator);
  std::vector<Scene> frames;
  for (const std::string& scene : line.scenes) {
    frames.push_back(load(scene));
    for (const std::string& note : frames.back().notes.messages) fmt::print(stderr, "boxwood-viewer: {}\n", note);
  }
  App(frames, line.app).run();
}

}  // namespace
}  // namespace boxwood::viewer

int main(int argc, char** argv) {
  using namespace boxwood::viewer;
  CommandLine line;
  line.app.recipes.clear();
  CLI::App cli{"Fly through a scene while acceleration structures are switched under it. Press h for the keys."};
  cli.name("boxwood-viewer");
  cli.add_option("SCENE", line.scenes, "a file or generate:NAME(…); several are the frames of a sequence");
  cli.add_option("-a,--recipe", line.app.recipes, "recipe to trace with; the first two are compared, r switches")
      ->expected(1)
      ->take_all();
  cli.add_option("--integrator", line.app.integrator, "what is painted at first");
  cli.add_option("--camera", line.app.camera, "name of the scene's camera to start from");
  cli.add_option("--size", line.size, "of the window");
  cli.add_option("--threads", line.app.threads, "to paint with; 0: all");
  cli.add_option("--samples", line.app.samples, "per pixel, at most; 1 goes through the pixel's centre");
  cli.add_flag("--time-transfers", line.time_transfers,
               "time how a picture of --size gets to the graphics card, in both ways, and leave");
  cli.add_option("--folder", line.app.folder, "where pictures and cameras are saved");
  try {
    cli.parse(argc, argv);
  } catch (const CLI::CallForHelp& help) {
    return cli.exit(help);
  } catch (const CLI::ParseError& error) {
    fmt::print(stderr, "boxwood-viewer: {}\n", error.what());
    return exit_usage;
  }
  try {
    run(line);
  } catch (const boxwood::UsageError& error) {
    fmt::print(stderr, "boxwood-viewer: {}\n", error.what());
    return exit_usage;
  } catch (const std::exception& error) {
    fmt::print(stderr, "boxwood-viewer: {}\n", error.what());
    return exit_failed;
  }
  return 0;
}
