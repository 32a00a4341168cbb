#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include "command.h"

namespace boxwood::cli {

/// What most commands take.
struct CommonOptions {
  unsigned threads = 0;  ///< 0: as many as the machine has
  bool json = false;     ///< one JSON document on standard output and nothing else there
};

/// From where a scene is looked at.
struct ViewOptions {
  std::string camera;  ///< name; empty: the scene's first
  std::uint32_t width = 512, height = 512;
  std::uint32_t block = 4;  ///< one pixel of each block x block stands for all, for recipes that adapt to the view
  bool sized = false;       ///< whether the size was asked for
};

// What several commands declare alike.

void add_json(Command& command, bool& json);
/// --threads and --json; the help says what `threads` is unless given.
void add_common(Command& command, CommonOptions& common);
void add_view(Command& command, ViewOptions& view);
void add_scene(Command& command, std::string& scene);
void add_scenes(Command& command, std::vector<std::string>& scenes);
void add_recipe(Command& command, std::string& recipe);
void add_recipes(Command& command, std::vector<std::string>& recipes, const std::string& help);

}  // namespace boxwood::cli
