#pragma once
#include <vector>

#include "boxwood/recipe.h"

namespace boxwood {

/// What advice chooses among, made from the registry, so that a new stage takes part from the day it is registered:
/// the presets; every builder on every way of laying out (each layout at several widths, each refinement, and chains of
/// refinements that are known to pay); the usual builders with every cost model, and with every word that one of their
/// options takes. Each recipe once; none is a peer.
std::vector<Recipe> candidate_recipes();

}  // namespace boxwood
