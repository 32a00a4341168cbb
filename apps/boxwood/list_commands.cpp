// `boxwood recipes` and `boxwood scenes`: what there is, straight from the registries.
#include "commands.h"
#include "console.h"
#include "exit_code.h"
#include "report/catalog_text.h"
#include "report/json.h"

namespace boxwood::cli {

int run_recipes(const ListOptions& options) {
  if (options.json) {
    print_json(to_json(stages(), presets()));
  } else {
    print(options.markdown ? recipes_markdown(stages(), presets()) : recipes_text(stages(), presets()));
  }
  return exit_done;
}

int run_scenes(const ListOptions& options) {
  if (options.json) {
    print_json(to_json(generators(), scene_sources()));
  } else {
    print(scenes_text(generators(), scene_sources()));
  }
  return exit_done;
}

}  // namespace boxwood::cli
