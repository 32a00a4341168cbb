// `boxwood recipes` and `boxwood scenes`: what there is, straight from the registries.
#include <memory>

#include "command.h"
#include "console.h"
#include "exit_code.h"
#include "report/catalog_text.h"
#include "report/json.h"
#include "shared_options.h"

namespace boxwood::cli {
namespace {

struct RecipesOptions {
  bool json = false;
  bool markdown = false;
};

int run_recipes(const RecipesOptions& options) {
  if (options.json) {
    print_json(to_json(stages(), presets()));
  } else {
    print(options.markdown ? recipes_markdown(stages(), presets()) : recipes_text(stages(), presets()));
  }
  return exit_done;
}

int run_scenes(bool json) {
  if (json) {
    print_json(to_json(generators(), scene_sources()));
  } else {
    print(scenes_text(generators(), scene_sources()));
  }
  return exit_done;
}

}  // namespace

void add_recipes(CommandSet& commands) {
  const auto options = std::make_shared<RecipesOptions>();
  Command command =
      commands.add("recipes", "List every stage that a recipe can have, with its options, and the presets",
                   [options] { return run_recipes(*options); });
  command.flag("--markdown", options->markdown, "Print the page docs/recipes.md");
  add_json(command, options->json);
  command.conflict("--json", "--markdown");
}

void add_scenes(CommandSet& commands) {
  const auto json = std::make_shared<bool>(false);
  Command command = commands.add("scenes", "List what can be generated, and where real scenes come from",
                                 [json] { return run_scenes(*json); });
  add_json(command, *json);
}

}  // namespace boxwood::cli
