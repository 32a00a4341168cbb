#pragma once
#include <string>
#include <vector>

#include "boxwood/error.h"
#include "boxwood/recipe.h"
#include "recipe/stage.h"

namespace boxwood::test {

/// Every layout there is, over `builder` or, where that does not suit it, over an octree.
inline std::vector<std::string> recipe_of_every_layout(const std::string& builder) {
  std::vector<std::string> out;
  for (const Stage& stage : stages()) {
    if (stage.kind != StageKind::layout) continue;
    for (const std::string& first : {builder, std::string("octree")}) {
      try {
        Recipe::parse(first + " > " + stage.name);
      } catch (const UsageError&) {
        continue;
      }
      out.push_back(first + " > " + stage.name);
      break;
    }
  }
  return out;
}

}  // namespace boxwood::test
