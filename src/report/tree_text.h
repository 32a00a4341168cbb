#pragma once
#include <string>

#include "tree/statistics.h"

namespace boxwood {

/// Everything known about a tree: counts, cost, leaf sizes and arities as bars, sibling overlap level by level.
std::string tree_text(const TreeStatistics& statistics);

}  // namespace boxwood
