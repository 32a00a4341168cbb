#include "shared_options.h"

#include <fmt/format.h>

#include "boxwood/error.h"
#include "options/options.h"

namespace boxwood::cli {
namespace {

constexpr std::uint32_t most_threads = 1024;
constexpr std::uint32_t most_pixels_per_side = 16384;

/// "640x480" into width and height.
void parse_size(const std::string& text, ViewOptions& view) {
  const auto wrong = [&] {
    return UsageError(
        fmt::format("takes WIDTHxHEIGHT, each 1…{}, such as 640x480, not '{}'", most_pixels_per_side, text));
  };
  const auto times = text.find('x');
  if (times == std::string::npos) throw wrong();
  try {
    view.width = option_text::parse_integer(text.substr(0, times), 1, most_pixels_per_side);
    view.height = option_text::parse_integer(text.substr(times + 1), 1, most_pixels_per_side);
  } catch (const UsageError&) {
    throw wrong();
  }
  view.sized = true;
}

}  // namespace

void add_json(Command& command, bool& json) {
  command.flag("--json", json, "Print one JSON document and nothing else");
}

void add_common(Command& command, CommonOptions& common) {
  command.integer("--threads", common.threads, 1, most_threads, "Threads to build and trace with",
                  common.threads == 0 ? "all" : "");
  add_json(command, common.json);
}

void add_view(Command& command, ViewOptions& view) {
  command.text("--camera", view.camera, "NAME", "Name of one of the scene's cameras", "first");
  command.parsed(
      "--size", [&view](const std::string& text) { parse_size(text, view); }, "WxH", "Pixels of the camera",
      fmt::format("{}x{}", view.width, view.height));
  command.integer("--block", view.block, 1, 1024,
                  "Recipes that adapt to what is traced learn from the rays of one pixel in each NxN");
}

void add_scene(Command& command, std::string& scene) {
  command.argument("SCENE", scene, "A file, or generate:NAME(option=value, …); see 'boxwood scenes'");
}

void add_scenes(Command& command, std::vector<std::string>& scenes) {
  command.arguments("SCENE", scenes, "Files, or generate:NAME(option=value, …); see 'boxwood scenes'");
}

void add_recipe(Command& command, std::string& recipe) {
  command.text("-a,--recipe", recipe, "RECIPE", "What to build; see 'boxwood recipes'");
}

void add_recipes(Command& command, std::vector<std::string>& recipes, const std::string& help) {
  command.repeated("-a,--recipe", recipes, "RECIPE", help);
}

}  // namespace boxwood::cli
