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

/// Keeps in the store a rendering of the scene's first view and, for each recipe, a heat map and a picture of primitive
/// tests alone, each kind on one scale; nothing when they are there already. Kind "rendering" has no recipe, "heatmap"
/// and "primitive tests" have the label. Runs in the caller's arena.
void keep_pictures(const Study& study, const StudyScene& scene, const std::vector<PicturedRecipe>& recipes,
                   Store& store);

}  // namespace boxwood
