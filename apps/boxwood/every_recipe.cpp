#include "every_recipe.h"

#include <fmt/format.h>

#include <algorithm>
#include <string>
#include <string_view>

#include "boxwood/error.h"
#include "recipe/stage.h"

namespace boxwood::cli {
namespace {

constexpr std::string_view usual_builder = "binned";

std::vector<const Stage*> stages_of(StageKind kind) {
  std::vector<const Stage*> out;
  for (const Stage& stage : stages()) {
    if (stage.kind == kind) out.push_back(&stage);
  }
  return out;
}

/// The usual builder, or one that tells the cells that a layout needs.
std::string builder_for(const Stage& layout) {
  if (!layout.cells) return std::string(usual_builder);
  for (const Stage* builder : stages_of(StageKind::builder)) {
    if (builder->cells) return builder->name;
  }
  throw Error(fmt::format("no builder makes the octrees that the layout '{}' needs", layout.name));
}

/// The values of an option that takes one of a few words.
std::vector<std::string> words(const Option& option) {
  constexpr std::string_view separator = " | ";
  std::vector<std::string> out;
  for (std::size_t begin = 0; option.values.find(separator) != std::string::npos;) {
    const std::size_t end = option.values.find(separator, begin);
    out.push_back(option.values.substr(begin, end - begin));
    if (end == std::string::npos) break;
    begin = end + separator.size();
  }
  return out;
}

/// `stages` on the first layout that can hold what they make.
Recipe on_fitting_layout(const std::string& stages) {
  const std::vector<const Stage*> layouts = stages_of(StageKind::layout);
  for (const Stage* layout : layouts) {
    try {
      return Recipe::parse(fmt::format("{} > {}", stages, layout->name));
    } catch (const UsageError&) {
      if (layout == layouts.back()) throw;
    }
  }
  throw Error("no layout is registered; this build of boxwood cannot trace");
}

/// One `trace(option=word)` for each word that is not the default, but for the precision, which few layouts take.
std::vector<std::string> ways_to_trace() {
  std::vector<std::string> out;
  for (const Stage* stage : stages_of(StageKind::trace)) {
    for (const Option& option : stage->options) {
      if (option.name == "precision") continue;
      for (const std::string& word : words(option)) {
        if (word != option.get(stage->defaults))
          out.push_back(fmt::format("{}({}={})", stage->name, option.name, word));
      }
    }
  }
  return out;
}

}  // namespace

std::vector<Recipe> every_recipe() {
  std::vector<Recipe> all;
  const auto add = [&](const Recipe& recipe) {
    if (std::ranges::find(all, recipe) == all.end()) all.push_back(recipe);
  };
  for (const Stage* layout : stages_of(StageKind::layout)) {
    const std::string walked = fmt::format("{} > {}", builder_for(*layout), layout->name);
    add(Recipe::parse(walked));
    for (const std::string& trace : ways_to_trace()) add(Recipe::parse(fmt::format("{} > {}", walked, trace)));
  }
  for (const Stage* builder : stages_of(StageKind::builder)) add(on_fitting_layout(builder->name));
  for (const Stage* refinement : stages_of(StageKind::refinement)) {
    add(on_fitting_layout(fmt::format("{} > {}", usual_builder, refinement->name)));
  }
  return all;
}

}  // namespace boxwood::cli
