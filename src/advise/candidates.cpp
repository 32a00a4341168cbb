#include "advise/candidates.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <utility>

#include "boxwood/error.h"
#include "cost/registry.h"
#include "recipe/stage.h"

namespace boxwood {
namespace {

/// Whose options and cost models are searched, not only their defaults: those that measured well wherever they were.
constexpr std::string_view usual_builders[] = {"binned", "spatial", "ploc"};
/// On which that is done.
constexpr std::string_view usual_tails[] = {"wide(8)", "reinsert > optimal-collapse(8) > wide(8)"};
/// Refinements that build on each other.
constexpr std::string_view chains[] = {
    "reinsert > optimal-collapse(4) > wide(4)",
    "reinsert > optimal-collapse(8) > wide(8)",
    "reinsert > optimal-collapse(16) > wide(16)",
    "reinsert > optimal-collapse(8, leaf=8, block=8) > compressed(8)",
};

std::vector<std::string> words(const Option& option) {
  std::vector<std::string> out;
  std::string_view rest = option.values;
  if (rest.find(" | ") == std::string_view::npos) return out;
  for (std::size_t end; (end = rest.find(" | ")) != std::string_view::npos; rest.remove_prefix(end + 3)) {
    out.emplace_back(rest.substr(0, end));
  }
  out.emplace_back(rest);
  return out;
}

/// A layout as it is, and at the widths that machines like where it has one.
std::vector<std::string> forms(const Stage& layout) {
  std::vector<std::string> out = {layout.name};
  for (const Option& option : layout.options) {
    if (option.positional && option.name == "k") {
      for (const int width : {4, 8, 16}) out.push_back(fmt::format("{}({})", layout.name, width));
    }
  }
  return out;
}

std::vector<std::string> tails() {
  std::vector<std::string> out(std::begin(chains), std::end(chains));
  for (const Stage& stage : stages()) {
    if (stage.kind == StageKind::layout) {
      for (std::string& form : forms(stage)) out.push_back(std::move(form));
    } else if (stage.kind == StageKind::refinement) {
      out.push_back(fmt::format("{} > wide(8)", stage.name));
    }
  }
  return out;
}

/// The usual builders with one option set otherwise.
std::vector<std::string> special_heads() {
  std::vector<std::string> out;
  for (const Stage& stage : stages()) {
    if (std::ranges::find(usual_builders, stage.name) == std::end(usual_builders)) continue;
    for (const Option& option : stage.options) {
      for (const std::string& word : words(option)) {
        out.push_back(fmt::format("{}({}={})", stage.name, option.name, word));
      }
      if (option.name == "cost") {
        for (const CostModelEntry& model : cost_models())
          out.push_back(fmt::format("{}(cost={})", stage.name, model.name));
      }
      if (option.name == "leaf") {
        for (const int leaf : {1, 2, 8}) out.push_back(fmt::format("{}(leaf={})", stage.name, leaf));
      }
    }
  }
  return out;
}

/// The first `leading` as they are, then the others in steps of the golden ratio: whatever part of them there is time
/// for has some of every builder and layout.
std::vector<Recipe> spread(std::vector<Recipe> recipes, std::size_t leading) {
  constexpr double golden_ratio = 0.6180339887498949;
  std::vector<std::pair<double, std::size_t>> places;
  for (std::size_t i = leading; i < recipes.size(); ++i) {
    const double turns = static_cast<double>(i) * golden_ratio;
    places.emplace_back(turns - std::floor(turns), i);
  }
  std::ranges::sort(places);
  std::vector<Recipe> out(recipes.begin(), recipes.begin() + static_cast<std::ptrdiff_t>(leading));
  for (const auto& [place, i] : places) out.push_back(std::move(recipes[i]));
  return out;
}

class Collector {
 public:
  /// Stages that do not fit each other are no candidate.
  void add(const std::string& text) {
    try {
      const Recipe recipe = Recipe::parse(text);
      if (seen_.insert(recipe.text()).second) recipes_.push_back(recipe);
    } catch (const UsageError&) {
    }
  }
  std::size_t size() const { return recipes_.size(); }
  std::vector<Recipe> take() { return std::move(recipes_); }

 private:
  std::set<std::string> seen_;
  std::vector<Recipe> recipes_;
};

}  // namespace

std::vector<Recipe> candidate_recipes() {
  Collector all;
  for (const Preset& preset : presets()) all.add(text_here(preset));
  for (const std::string_view tail : chains) {
    for (const std::string_view builder : usual_builders) all.add(fmt::format("{} > {}", builder, tail));
  }
  const std::size_t leading = all.size();
  for (const std::string& head : special_heads()) {
    for (const std::string_view tail : usual_tails) all.add(fmt::format("{} > {}", head, tail));
  }
  const std::vector<std::string> ends = tails();
  for (const Stage& stage : stages()) {
    if (stage.kind != StageKind::builder) continue;
    for (const std::string& tail : ends) all.add(fmt::format("{} > {}", stage.name, tail));
  }
  return spread(all.take(), leading);
}

}  // namespace boxwood
