// The only file that knows CLI11: turns arguments into option structs.
#include "command_line.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <memory>

#include "boxwood/error.h"
#include "boxwood/ray_set.h"
#include "commands.h"
#include "console.h"
#include "exit_code.h"
#include "options/options.h"
#include "options/suggest.h"
#include "render/integrator.h"

namespace boxwood::cli {
namespace {

constexpr unsigned most_threads = 1024;
constexpr std::uint32_t most_pixels_per_side = 16384;

/// Everything the parser fills in. Lives as long as the command that it returns.
struct Request {
  RenderOptions render;
  CompareOptions compare;
  InspectOptions inspect;
  VerifyOptions verify;
  BenchOptions bench;
  ListOptions recipes, scenes;
  std::function<int()> command;
};

template <class Range>
std::string names_of(const Range& range) {
  std::vector<std::string> names;
  for (const auto& name : range) names.emplace_back(name);
  return option_text::join(names, ", ");
}

std::string integrator_names() {
  std::vector<std::string_view> names;
  for (const Integrator& integrator : integrators()) names.push_back(integrator.name);
  return names_of(names);
}

/// "640x480" into width and height.
void parse_size(const std::string& text, ViewOptions& view) {
  const auto fail = [&] {
    throw CLI::ValidationError(
        "--size", fmt::format("takes WIDTHxHEIGHT, each 1…{}, such as 640x480, not '{}'", most_pixels_per_side, text));
  };
  const auto times = text.find('x');
  if (times == std::string::npos) fail();
  try {
    view.width = option_text::parse_integer(text.substr(0, times), 1, most_pixels_per_side);
    view.height = option_text::parse_integer(text.substr(times + 1), 1, most_pixels_per_side);
  } catch (const UsageError&) {
    fail();
  }
}

void add_json(CLI::App& app, bool& json) { app.add_flag("--json", json, "Print one JSON document and nothing else"); }

void add_common(CLI::App& app, CommonOptions& common, const std::string& default_threads) {
  app.add_option("--threads", common.threads, "Threads to build and trace with")
      ->type_name("N")
      ->check(CLI::Range(1u, most_threads))
      ->default_str(default_threads);
  add_json(app, common.json);
}

void add_view(CLI::App& app, ViewOptions& view) {
  app.add_option("--camera", view.camera, "Name of one of the scene's cameras")
      ->type_name("NAME")
      ->default_str("first");
  app.add_option_function<std::string>(
         "--size", [&view](const std::string& text) { parse_size(text, view); }, "Pixels of the camera")
      ->type_name("WxH")
      ->default_str(fmt::format("{}x{}", view.width, view.height));
}

void add_scene(CLI::App& app, std::string& scene) {
  app.add_option("SCENE", scene, "A file, or generate:NAME(option=value, …); see 'boxwood scenes'")
      ->required()
      ->type_name("");
}

void add_recipe(CLI::App& app, std::string& recipe) {
  app.add_option("-a,--recipe", recipe, "What to build; see 'boxwood recipes'")
      ->type_name("RECIPE")
      ->capture_default_str();
}

void add_recipes(CLI::App& app, std::vector<std::string>& recipes, const std::string& help) {
  app.add_option("-a,--recipe", recipes, help)->type_name("RECIPE")->expected(1)->take_all();
}

CLI::App& add_command(CLI::App& app, const char* name, const char* summary, Request& request,
                      std::function<int()> command) {
  CLI::App* added = app.add_subcommand(name, summary);
  added->callback([&request, command = std::move(command)] { request.command = command; });
  return *added;
}

void describe_render(CLI::App& app, Request& request) {
  RenderOptions& options = request.render;
  CLI::App& command = add_command(app, "render", "Render a scene", request, [&options] { return run_render(options); });
  add_scene(command, options.scene);
  add_recipe(command, options.recipe);
  command.add_option("--integrator", options.integrator, "One of " + integrator_names())
      ->type_name("NAME")
      ->capture_default_str();
  add_view(command, options.view);
  command.add_option("--spp", options.spp, "Samples per pixel")
      ->type_name("N")
      ->check(CLI::Range(1u, 1u << 20))
      ->capture_default_str();
  command.add_option("-o,--output", options.output, "Picture to write, .png or .exr")
      ->type_name("FILE")
      ->capture_default_str();
  command.add_flag("--force", options.force, "Replace the picture if there is one");
  add_common(command, options.common, "all");
}

void describe_compare(CLI::App& app, Request& request) {
  CompareOptions& options = request.compare;
  CLI::App& command = add_command(app, "compare", "Find out which recipe is faster on which rays, by how much and why",
                                  request, [&options] { return run_compare(options); });
  command.add_option("SCENE", options.scenes, "Files, or generate:NAME(option=value, …); see 'boxwood scenes'")
      ->required()
      ->type_name("…");
  add_recipes(command, options.recipes, "A contestant; say it once for each (none: a spread of everything there is)");
  command.add_option("--rays", options.rays, "Comma-separated ray kinds: " + names_of(ray_kinds()))
      ->type_name("KINDS")
      ->delimiter(',')
      ->allow_extra_args(false)
      ->default_str("primary,shadow,ao,diffuse");
  command.add_option("--repeat", options.repeats, "Timed passes over each ray set")
      ->type_name("N")
      ->check(CLI::Range(1u, 10000u))
      ->capture_default_str();
  add_view(command, options.view);
  command.add_option("--save-rays", options.save_rays, "Write the rays that were traced to a file")->type_name("FILE");
  command.add_option("--load-rays", options.load_rays, "Trace the rays of such a file")->type_name("FILE");
  command.add_option("--images", options.images, "Write a rendering and heat maps into a folder")->type_name("DIR");
  command.add_flag("--force", options.force, "Replace files that exist");
  add_common(command, options.common, "1");
}

void describe_inspect(CLI::App& app, Request& request) {
  InspectOptions& options = request.inspect;
  CLI::App& command = add_command(app, "inspect", "Show everything that is known about one tree", request,
                                  [&options] { return run_inspect(options); });
  add_scene(command, options.scene);
  add_recipe(command, options.recipe);
  add_common(command, options.common, "all");
}

void describe_verify(CLI::App& app, Request& request) {
  VerifyOptions& options = request.verify;
  CLI::App& command = add_command(app, "verify", "Check answers against brute force, and closed meshes for leaks",
                                  request, [&options] { return run_verify(options); });
  add_scene(command, options.scene);
  add_recipes(command, options.recipes, "What to check; say it once for each (none: everything there is)");
  command.add_option("--rays", options.rays, "Rays at most; large meshes get fewer")
      ->type_name("N")
      ->check(CLI::Range(1u, 100000000u))
      ->capture_default_str();
  command.add_option("--load-rays", options.load_rays, "Also check the rays of a file")->type_name("FILE");
  add_view(command, options.view);
  add_common(command, options.common, "all");
}

void describe_bench(CLI::App& app, Request& request) {
  BenchOptions& options = request.bench;
  CLI::App& command = add_command(app, "bench", "Measure the project's own speed: building, memory, tracing", request,
                                  [&options] { return run_bench(options); });
  command.add_option("--peer", options.peer, "Library to measure against in the same run")
      ->type_name("NAME")
      ->check(CLI::IsMember({"embree"}));
  command.add_flag("--quick", options.quick, "Smaller scenes, fewer repeats");
  command.add_flag("--huge", options.huge, "Also build 28 million triangles");
  add_common(command, options.common, "1");
}

void describe_lists(CLI::App& app, Request& request) {
  CLI::App& recipes =
      add_command(app, "recipes", "List every stage that a recipe can have, with its options, and the presets", request,
                  [&request] { return run_recipes(request.recipes); });
  CLI::Option* markdown = recipes.add_flag("--markdown", request.recipes.markdown, "Print the page docs/recipes.md");
  recipes.add_flag("--json", request.recipes.json, "Print one JSON document and nothing else")->excludes(markdown);
  CLI::App& scenes = add_command(app, "scenes", "List what can be generated, and where real scenes come from", request,
                                 [&request] { return run_scenes(request.scenes); });
  add_json(scenes, request.scenes.json);
}

const CLI::App& chosen(const CLI::App& app) {
  const auto commands = app.get_subcommands();
  return commands.empty() ? app : *commands.front();
}

/// What could have been meant by an argument that nobody took.
std::string hint(const CLI::App& app, const std::string& wrong) {
  std::vector<std::string> names;
  if (wrong.starts_with("-")) {
    for (const CLI::Option* option : app.get_options()) {
      if (!option->get_positional()) names.push_back(option->get_name());
    }
    return fmt::format("there is no option '{}'; {}", wrong, suggest(wrong.substr(0, wrong.find('=')), names));
  }
  for (const CLI::App* command : app.get_subcommands([](const CLI::App*) { return true; })) {
    names.push_back(command->get_name());
  }
  if (names.empty()) return fmt::format("'{}' is one argument too many", wrong);
  return fmt::format("there is no command '{}'; {}", wrong, suggest(wrong, names));
}

[[noreturn]] void explain(const CLI::App& app, const CLI::ParseError& error) {
  const CLI::App& command = chosen(app);
  const std::string where = &command == &app ? "" : fmt::format("{}: ", command.get_name());
  if (error.get_exit_code() == static_cast<int>(CLI::ExitCodes::ExtrasError)) {
    throw UsageError(fmt::format("{}{}", where, hint(command, app.remaining(true).front())));
  }
  throw UsageError(fmt::format("{}{}; see 'boxwood {}--help'", where, error.what(),
                               &command == &app ? "" : fmt::format("{} ", command.get_name())));
}

std::function<int()> printing(std::string text) {
  return [text = std::move(text)] {
    print(text);
    return exit_done;
  };
}

}  // namespace

std::function<int()> parse_command_line(int count, const char* const* arguments) {
  const auto request = std::make_shared<Request>();
  CLI::App app("Boxwood: which acceleration structure should trace this scene, for these rays?", "boxwood");
  app.set_version_flag("--version", "boxwood " BOXWOOD_VERSION);
  app.require_subcommand(0, 1);
  describe_render(app, *request);
  describe_compare(app, *request);
  describe_inspect(app, *request);
  describe_verify(app, *request);
  describe_bench(app, *request);
  describe_lists(app, *request);
  try {
    app.parse(count, arguments);
  } catch (const CLI::CallForHelp&) {
    return printing(app.help());
  } catch (const CLI::CallForVersion& asked) {
    return printing(fmt::format("{}\n", asked.what()));
  } catch (const CLI::ParseError& error) {
    explain(app, error);
  }
  if (!request->command) return printing(app.help());
  return [request] { return request->command(); };
}

}  // namespace boxwood::cli
