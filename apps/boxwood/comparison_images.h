#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "boxwood/recipe.h"
#include "boxwood/scene.h"
#include "shared_options.h"

namespace boxwood::cli {

struct HeatMap {
  std::string recipe, file;
};

/// Pictures of one scene. One rendering stands for all recipes, because they see the same to the last bit.
struct ComparisonImages {
  std::string rendering;
  std::vector<HeatMap> heat_maps;  ///< of all recipes but peers, which do not count their tests
  float scale = 0;                 ///< tests per ray at full brightness, the same in all, so that they compare
};

/// Throws UsageError when a picture of write_images() exists and may not be replaced. For before the work.
void check_images(const std::filesystem::path& folder, const Scene& scene, const std::vector<Recipe>& recipes,
                  bool force);

/// Writes FOLDER/SCENE.png and FOLDER/SCENE-heat-NN-RECIPE.png; makes the folder. Throws Error when it cannot.
ComparisonImages write_images(const std::filesystem::path& folder, const Scene& scene,
                              const std::vector<Recipe>& recipes, const ViewOptions& view, unsigned threads);

}  // namespace boxwood::cli
