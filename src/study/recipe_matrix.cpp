#include "study/recipe_matrix.h"

#include <fmt/format.h>

#include <algorithm>

#include "boxwood/recipe.h"
#include "options/suggest.h"

namespace boxwood {
namespace {

constexpr std::size_t most_recipes = 1000;
constexpr int deepest_nesting = 8;  // of placeholders in placeholders

/// A level, and what stands for it in the recipe.
struct Level {
  std::string name, text;
};

struct FactorLevels {
  std::string factor;
  std::vector<Level> levels;
};

std::vector<Level> read_levels(const TomlValue& value) {
  std::vector<Level> levels;
  if (value.is_table()) {
    for (const auto& [level, text] : value.table()) levels.push_back({level, text.word()});
  } else {
    for (const std::string& word : value.words()) levels.push_back({word, word});
  }
  if (levels.empty()) value.fail("needs at least one value");
  return levels;
}

/// Of `all`, those that `value` names; "*" names them all.
std::vector<Level> pick_levels(const TomlValue& value, const std::vector<Level>& all) {
  if (value.is_text() && value.text() == "*") return all;
  std::vector<std::string> names;
  names.reserve(all.size());
  for (const Level& level : all) names.push_back(level.name);
  std::vector<Level> picked;
  for (const std::string& word : value.words()) {
    const auto found = std::ranges::find(all, word, &Level::name);
    if (found == all.end()) value.fail(fmt::format("knows no '{}'; {}", word, suggest(word, names)));
    picked.push_back(*found);
  }
  return picked;
}

const TomlValue* find_shared(const TomlValue* shared, const std::string& factor) {
  if (!shared) return nullptr;
  for (const auto& [name, value] : shared->table()) {
    if (name == factor) return &value;
  }
  return nullptr;
}

std::vector<FactorLevels> read_values(const TomlValue* values, const TomlValue* shared) {
  std::vector<FactorLevels> out;
  if (!values) return out;
  for (const auto& [factor, value] : values->table()) {
    const TomlValue* common = find_shared(shared, factor);
    out.push_back(
        {factor, common && !value.is_table() ? pick_levels(value, read_levels(*common)) : read_levels(value)});
  }
  return out;
}

using Placeholders = std::map<std::string, std::string>;

/// Puts in values for {names} until none is left.
std::string fill(std::string text, const Placeholders& values, const TomlValue& where) {
  for (int round = 0; text.find('{') != std::string::npos; ++round) {
    if (round == deepest_nesting) where.fail(fmt::format("has placeholders in circles: {}", text));
    std::string out;
    for (std::size_t at = 0; at < text.size();) {
      if (text[at] != '{') {
        out += text[at++];
        continue;
      }
      const std::size_t end = text.find('}', at);
      if (end == std::string::npos) where.fail("has a '{' without a '}'");
      const std::string name = text.substr(at + 1, end - at - 1);
      const auto found = values.find(name);
      if (found == values.end()) where.fail(fmt::format("has a placeholder {{{}}} without values", name));
      out += found->second;
      at = end + 1;
    }
    text = std::move(out);
  }
  return text;
}

/// The next combination, like the digits of a counter; false after the last.
bool advance(std::vector<std::size_t>& digits, const std::vector<FactorLevels>& factors) {
  for (std::size_t i = digits.size(); i-- > 0;) {
    if (++digits[i] < factors[i].levels.size()) return true;
    digits[i] = 0;
  }
  return false;
}

}  // namespace

std::vector<RecipeSpec> recipe_matrix(const TomlValue& table, const TomlValue* shared) {
  TomlReader reader(table);
  const TomlValue& recipe = reader.need("recipe");
  const TomlValue* label = reader.find("label");
  const std::vector<FactorLevels> factors = read_values(reader.find("values"), shared);
  Factors fixed;
  if (const TomlValue* set = reader.find("set")) {
    for (const auto& [factor, level] : set->table()) fixed[factor] = level.word();
  }
  Placeholders more;
  if (const TomlValue* with = reader.find("with")) {
    for (const auto& [name, text] : with->table()) more[name] = text.word();
  }
  reader.done();

  std::vector<RecipeSpec> out;
  std::vector<std::size_t> digits(factors.size(), 0);
  do {
    RecipeSpec spec;
    spec.factors = fixed;
    Placeholders placeholders = fixed, levels = fixed;
    placeholders.insert(more.begin(), more.end());
    for (std::size_t i = 0; i < factors.size(); ++i) {
      const Level& level = factors[i].levels[digits[i]];
      spec.factors[factors[i].factor] = level.name;
      placeholders[factors[i].factor] = level.text;
      levels[factors[i].factor] = level.name;
    }
    spec.text = fill(recipe.text(), placeholders, recipe);
    try {
      spec.text = Recipe::parse(spec.text).text();
    } catch (const UsageError& error) {
      recipe.fail(fmt::format("becomes '{}': {}", spec.text, error.what()));
    }
    spec.label = label ? fill(label->text(), levels, *label) : spec.text;
    out.push_back(std::move(spec));
    if (out.size() > most_recipes) recipe.fail(fmt::format("makes more than {} recipes", most_recipes));
  } while (advance(digits, factors));
  return out;
}

}  // namespace boxwood
