#pragma once
#include <string>

#include "boxwood/recipe.h"
#include "math/random.h"

namespace boxwood {

struct Option;

/// A value that an option takes: a word of its list, a cost model, or a number near the low end of its range, where
/// degenerate cases are. Empty when its description is none of these.
std::string random_value(const Option& option, Random& random);

/// A recipe of random stages from the registry with random options, none a peer. Stages that do not fit each other are
/// drawn anew.
Recipe random_recipe(Random& random);

}  // namespace boxwood
