#pragma once
#include <tbb/global_control.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

#include "boxwood/recipe.h"
#include "boxwood/scene.h"
#include "boxwood/structure.h"
#include "shared_options.h"

namespace boxwood::cli {

/// load(), with a hint where scenes come from when there is no such file.
Scene load_scene(const std::string& path_or_generator);

/// The camera that `view` asks for. Throws UsageError naming the scene's cameras.
const Camera& find_camera(const Scene& scene, const ViewOptions& view);

/// Parses each; throws UsageError on the first that is wrong.
std::vector<Recipe> parse_recipes(const std::vector<std::string>& texts);
bool is_peer(const Recipe& recipe);

/// Throws unless `file` can be written without taking anything from the user: it must not exist, unless `force`, and
/// its folder must. For before the work, so that the work is not lost.
void check_can_write(const std::filesystem::path& file, bool force);
/// Also throws UsageError unless the name ends in .png or .exr.
void check_can_write_image(const std::filesystem::path& file, bool force);

/// What was wrong with the scene, one sentence each, ready to print; empty when nothing was.
std::vector<std::string> scene_notes(const Scene& scene);

/// Runs `work` on `threads` threads, 0 for all; on more than the machine has when asked for.
template <class Work>
auto run_in_arena(unsigned threads, const Work& work) {
  const auto available = static_cast<std::size_t>(tbb::this_task_arena::max_concurrency());
  const tbb::global_control allow(tbb::global_control::max_allowed_parallelism,
                                  std::max<std::size_t>(threads, available));
  tbb::task_arena arena(threads == 0 ? tbb::task_arena::automatic : static_cast<int>(threads));
  return arena.execute(work);
}

}  // namespace boxwood::cli
