#include "soak/random_recipe.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <string_view>
#include <vector>

#include "boxwood/error.h"
#include "cost/registry.h"
#include "recipe/capabilities.h"
#include "recipe/stage.h"

namespace boxwood {
namespace {

constexpr std::string_view to = "…", separator = " | ";

std::uint32_t below(Random& random, std::size_t count) { return random.below(static_cast<std::uint32_t>(count)); }

std::string random_word(std::string_view values, Random& random) {
  std::vector<std::string_view> words;
  for (std::size_t end; (end = values.find(separator)) != std::string_view::npos;) {
    words.push_back(values.substr(0, end));
    values.remove_prefix(end + separator.size());
  }
  words.push_back(values);
  return std::string(words[below(random, words.size())]);
}

/// Most trouble is with few: at most eight above the low end, now and then the high end where that is not a cost of
/// its own.
std::string random_number(std::string_view low_text, std::string_view high_text, Random& random) {
  constexpr double largest_high_end = 64;
  double low = 0, high = 0;
  std::from_chars(low_text.data(), low_text.data() + low_text.size(), low);
  std::from_chars(high_text.data(), high_text.data() + high_text.size(), high);
  const bool whole = low_text.find('.') == std::string_view::npos && high >= 2;
  if (!whole) return option_text::print_real(random.uniform(static_cast<float>(low), static_cast<float>(high)));
  const double most = high <= largest_high_end && random.below(4) == 0 ? high : std::min(high, low + 8);
  return fmt::format("{}", static_cast<std::uint32_t>(low) + random.below(static_cast<std::uint32_t>(most - low) + 1));
}

std::vector<const Stage*> stages_of(StageKind kind) {
  std::vector<const Stage*> out;
  for (const Stage& stage : stages()) {
    if (stage.kind == kind) out.push_back(&stage);
  }
  return out;
}

std::string random_call(StageKind kind, Random& random) {
  const std::vector<const Stage*> choice = stages_of(kind);
  const Stage& stage = *choice[below(random, choice.size())];
  std::string arguments;
  for (const Option& option : stage.options) {
    if (option.name == "most") continue;  // the time that 'exhaustive' takes grows as 3^most
    if (!option.positional && random.below(3) != 0) continue;
    const std::string value = random_value(option, random);
    if (value.empty()) continue;
    arguments += fmt::format("{}{}={}", arguments.empty() ? "" : ", ", option.name, value);
  }
  return fmt::format("{}({})", stage.name, arguments);
}

std::string random_text(Random& random) {
  std::string text = random_call(StageKind::builder, random);
  for (std::uint32_t n = random.below(3); n > 0; --n) text += " > " + random_call(StageKind::refinement, random);
  text += " > " + random_call(StageKind::layout, random);
  if (random.below(3) == 0) text += " > " + random_call(StageKind::trace, random);
  return text;
}

}  // namespace

std::string random_value(const Option& option, Random& random) {
  const std::string_view values = option.values;
  if (values == cost_model_names()) return cost_models()[below(random, cost_models().size())].name;
  if (const auto range = values.find(to); range != std::string_view::npos) {
    return random_number(values.substr(0, range), values.substr(range + to.size()), random);
  }
  if (values.find(separator) != std::string_view::npos) return random_word(values, random);
  return {};
}

Recipe random_recipe(Random& random) {
  constexpr int attempts = 1000;
  for (int attempt = 0; attempt < attempts; ++attempt) {
    try {
      Recipe recipe = Recipe::parse(random_text(random));
      if (answers_exactly(recipe.stages())) return recipe;
    } catch (const UsageError&) {  // they do not fit
    }
  }
  return Recipe::parse("default");
}

}  // namespace boxwood
