#pragma once
#include <vector>

#include "study/study.h"
#include "study/toml.h"

namespace boxwood {

/// The recipes of one [[recipes]] table: every combination of its values put in for {name} in its texts. A value may be
/// a table from level to text, and texts may hold further placeholders. Factors of `shared`, the file's own [values]
/// (null: none), are taken with factor = "*", or in part with a list of their levels. `set` has further factors, the
/// same for all; `with` has placeholders that are no factors. Throws UsageError naming the line.
std::vector<RecipeSpec> recipe_matrix(const TomlValue& table, const TomlValue* shared);

}  // namespace boxwood
