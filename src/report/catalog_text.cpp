#include "report/catalog_text.h"

#include <fmt/format.h>

#include <array>

#include "cost/registry.h"
#include "recipe/capabilities.h"
#include "report/number_text.h"
#include "report/table.h"

namespace boxwood {
namespace {

struct Section {
  StageKind kind;
  std::string_view name, title, role;
};

constexpr std::array sections = {
    Section{StageKind::builder, "builder", "Builders", "make the tree; a recipe begins with one"},
    Section{StageKind::refinement, "refinement", "Refinements", "rewrite the tree; any number of them"},
    Section{StageKind::layout, "layout", "Layouts", "encode the tree in memory, with their own kernels; one"},
    Section{StageKind::trace, "trace", "Tracing", "says how the layout is walked; last, may be left out"},
    Section{StageKind::peer, "peer", "Peers", "other libraries, to compare with; they stand alone"},
};

std::string indent(const std::string& text) {
  std::string out;
  for (std::size_t begin = 0; begin < text.size();) {
    const std::size_t end = text.find('\n', begin) + 1;
    out += fmt::format("      {}", text.substr(begin, end - begin));
    begin = end;
  }
  return out;
}

std::string quoted(const std::string& text, std::string_view code) { return fmt::format("{}{}{}", code, text, code); }

/// Options, one a line. `code` is put around what is typed.
Table option_table(std::span<const Option> options, const std::any& defaults, std::string_view code) {
  Table table({{"option", Align::left}, {"default", Align::left}, {"values", Align::left}, {"meaning", Align::left}});
  for (const Option& option : options) {
    table.add({quoted(option.name, code), quoted(option.get(defaults), code), option.values,
               option.positional ? option.help + " (may be given without its name)" : option.help});
  }
  return table;
}

std::string entry(const std::string& name, const std::string& summary, const Table& options) {
  return fmt::format("  {}: {}\n{}", name, summary, options.empty() ? "" : indent(options.text()));
}

template <class Write>
void for_each_section(std::span<const Stage> stages, const Write& write) {
  for (const Section& section : sections) {
    bool first = true;
    for (const Stage& stage : stages) {
      if (stage.kind != section.kind) continue;
      write(section, stage, first);
      first = false;
    }
  }
}

/// What an option such as `cost` takes.
std::string cost_models_text() {
  std::string out = "\nCost models (values of an option that takes one, as in cost=rdh(alpha=0.5))\n";
  for (const CostModelEntry& model : cost_models()) {
    out += entry(model.name, fmt::format("{} [{}]", model.summary, model.source),
                 option_table(model.options, model.defaults, ""));
  }
  return out;
}

std::string cost_models_markdown() {
  std::string out =
      "\n## Cost models\n\nvalues of an option that takes one, as in `cost=rdh(alpha=0.5)`; what they mean: "
      "[cost models](cost-models.md).\n";
  for (const CostModelEntry& model : cost_models()) {
    out += fmt::format("\n### `{}`\n\n{}. Source: {}.\n", model.name, model.summary, model.source);
    const Table options = option_table(model.options, model.defaults, "`");
    if (!options.empty()) out += fmt::format("\n{}", options.markdown());
  }
  return out;
}

/// Which layout and which peer answers what.
Table capability_table(std::span<const Stage> stages, std::string_view code) {
  std::vector<Table::Column> columns = {{"layout or peer", Align::left}};
  for (const CapabilityEntry& entry : capabilities()) columns.push_back({std::string(entry.name), Align::left});
  Table table(std::move(columns));
  for (const Stage& stage : stages) {
    if (!answers_queries(stage)) continue;
    std::vector<std::string> row = {quoted(stage.name, code)};
    for (const CapabilityEntry& entry : capabilities()) {
      row.emplace_back(has_capability(stage, entry.capability) ? "yes" : "refused");
    }
    table.add(row);
  }
  return table;
}

Table preset_table(std::span<const Preset> presets, std::string_view code) {
  Table table({{"preset", Align::left}, {"stands for", Align::left}, {"", Align::left}});
  for (const Preset& preset : presets) {
    table.add({quoted(preset.name, code), quoted(preset.text, code), preset.summary});
    if (!preset.text_avx512.empty()) table.add({"", quoted(preset.text_avx512, code), "the same with AVX-512"});
  }
  return table;
}

}  // namespace

std::string_view stage_kind_name(StageKind kind) {
  for (const Section& section : sections) {
    if (section.kind == kind) return section.name;
  }
  return "stage";
}

std::string recipes_text(std::span<const Stage> stages, std::span<const Preset> presets) {
  std::string out =
      "A recipe is BUILDER > REFINEMENT > … > LAYOUT > trace(…), such as\n"
      "  sweep(k=4) > wide(4) > trace(order=near)\n";
  for_each_section(stages, [&](const Section& section, const Stage& stage, bool first) {
    if (first) out += fmt::format("\n{} ({})\n", section.title, section.role);
    out += entry(stage.name, fmt::format("{} [{}]", stage.summary, stage.source),
                 option_table(stage.options, stage.defaults, ""));
  });
  return fmt::format("{}{}\nWhat can be asked of a structure (distances: of any scene, apart from its recipe)\n{}\n{}",
                     out, cost_models_text(), indent(capability_table(stages, "").text()),
                     preset_table(presets, "").text());
}

std::string recipes_markdown(std::span<const Stage> stages, std::span<const Preset> presets) {
  std::string out =
      "# Recipes\n\n"
      "Written by `boxwood recipes --markdown` (`make docs`) from the registry that the parser uses; do not edit.\n\n"
      "A recipe is `BUILDER > REFINEMENT > … > LAYOUT > trace(…)`, such as `sweep(k=4) > wide(4) > trace(order=near)`, "
      "or\n"
      "the name of a preset. Refinements and `trace` may be left out; options not given keep their defaults.\n";
  for_each_section(stages, [&](const Section& section, const Stage& stage, bool first) {
    if (first) out += fmt::format("\n## {}\n\n{}.\n", section.title, section.role);
    out += fmt::format("\n### `{}`\n\n{}. Source: {}.\n", stage.name, stage.summary, stage.source);
    const Table options = option_table(stage.options, stage.defaults, "`");
    if (!options.empty()) out += fmt::format("\n{}", options.markdown());
  });
  return fmt::format(
      "{}{}\n## Queries\n\nwhat can be asked of a structure; distances are asked of any scene, apart from its recipe: "
      "[queries](queries.md).\n\n{}\n## Presets\n\n{}",
      out, cost_models_markdown(), capability_table(stages, "`").markdown(), preset_table(presets, "`").markdown());
}

std::string scenes_text(std::span<const Generator> generators, std::span<const SceneSource> sources) {
  std::string out = "Generated scenes, written generate:NAME or generate:NAME(option=value, …)\n\n";
  for (const Generator& generator : generators) {
    out += entry(generator.name, generator.summary, option_table(generator.options, generator.defaults, ""));
  }
  out += "\nReal scenes that packages bring\n\n";
  Table table(
      {{"install with", Align::left}, {"file", Align::left}, {"triangles"}, {"here"}, {"what it is", Align::left}});
  for (const SceneSource& source : sources) {
    table.add({source.installer, source.path, source.triangles == 0 ? "–" : grouped(source.triangles),
               is_installed(source) ? "yes" : "no",
               source.readable ? source.summary : source.summary + " (cannot be read as it stands)"});
  }
  return fmt::format("{}{}\nAny OBJ, PLY, glTF, GLB or STL file is a scene too.\n", out, table.text());
}

}  // namespace boxwood
