// `boxwood view`: starts the viewer, a program of its own beside this one, so that this one needs no OpenGL.
#include <fmt/format.h>
#include <unistd.h>

#include <array>
#include <filesystem>
#include <memory>

#include "boxwood/error.h"
#include "command.h"
#include "shared_options.h"
#include "workspace.h"

namespace boxwood::cli {
namespace {

struct ViewerOptions {
  std::vector<std::string> scenes, recipes;
  std::string integrator = "eyelight";
  std::string camera, size = "1280x720", folder = ".";
  std::uint32_t threads = 0, samples = 64;
};

std::filesystem::path viewer_program() {
  std::error_code error;
  const std::filesystem::path self = std::filesystem::read_symlink("/proc/self/exe", error);
  std::filesystem::path viewer = self.parent_path() / "boxwood-viewer";
  if (error || !std::filesystem::exists(viewer)) {
    throw Error(
        fmt::format("there is no viewer at '{}'; it is built where GLFW and Dear ImGui are installed "
                    "(libglfw3-dev and libimgui-dev), by 'make build'",
                    viewer.string()));
  }
  return viewer;
}

int run_view(const ViewerOptions& options) {
  parse_recipes(options.recipes);
  const std::filesystem::path viewer = viewer_program();
  std::vector<std::string> words{viewer.string()};
  words.insert(words.end(), options.scenes.begin(), options.scenes.end());
  for (const std::string& recipe : options.recipes) words.insert(words.end(), {"-a", recipe});
  if (!options.camera.empty()) words.insert(words.end(), {"--camera", options.camera});
  words.insert(words.end(),
               {"--integrator", options.integrator, "--size", options.size, "--folder", options.folder, "--threads",
                std::to_string(options.threads), "--samples", std::to_string(options.samples)});
  std::vector<char*> arguments;
  arguments.reserve(words.size() + 1);
  for (std::string& word : words) arguments.push_back(word.data());
  arguments.push_back(nullptr);
  execv(viewer.c_str(), arguments.data());
  throw Error(fmt::format("cannot start '{}'; see whether it may be run", viewer.string()));
}

}  // namespace

void add_view_command(CommandSet& commands) {
  const auto options = std::make_shared<ViewerOptions>();
  Command command = commands.add("view", "Fly through a scene while structures are switched",
                                 [options] { return run_view(*options); });
  command.arguments("SCENE", options->scenes, "A file or generate:NAME(…); several are the frames of a sequence");
  add_recipes(command, options->recipes,
              "Recipe to trace with; the first two are compared, the others can be switched to");
  command.text("--integrator", options->integrator, "NAME", "What is painted at first");
  command.text("--camera", options->camera, "NAME", "Name of the scene's camera to start from", "first");
  command.text("--size", options->size, "WxH", "Of the window");
  command.text("--folder", options->folder, "FOLDER", "Where pictures and cameras are saved");
  command.integer("--threads", options->threads, 1, 1024, "Threads to paint with", "all");
  command.integer("--samples", options->samples, 1, 1u << 16, "Per pixel, at most; 1 goes through its centre");
}

}  // namespace boxwood::cli
