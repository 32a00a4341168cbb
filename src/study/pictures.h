#pragma once
#include <string>
#include <vector>

#include "boxwood/structure.h"
#include "store/store.h"
#include "study/scene_finder.h"
#include "study/study.h"

namespace boxwood {

/// A recipe whose heat map is wanted.
struct PicturedRecipe {
  std::string label;
  const Structure* structure;
};

/// Keeps a rendering of the scene's first view and a heat map of each recipe in the store, all on one scale; nothing
/// when they are there already. Kind "rendering" has no recipe, "heatmap" has the label. Runs in the caller's arena.
void keep_pictures(const Study& study, const StudyScene& scene, const std::vector<PicturedRecipe>& recipes,
                   Store& store);

}  // namespace boxwood
