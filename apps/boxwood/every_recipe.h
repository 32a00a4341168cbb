#pragma once
#include <vector>

#include "boxwood/recipe.h"

namespace boxwood::cli {

/// Recipes that use every registered stage of our own at least once: each builder, each refinement, each layout, and
/// each layout walked with each value of each option of `trace` but the precision. A stage that is registered tomorrow
/// is in it.
std::vector<Recipe> every_recipe();

}  // namespace boxwood::cli
