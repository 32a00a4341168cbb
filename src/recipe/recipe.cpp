#include "boxwood/recipe.h"

#include <fmt/format.h>

#include "options/call.h"
#include "options/suggest.h"
#include "recipe/capabilities.h"
#include "recipe/stage.h"

namespace boxwood {
namespace {

/// A builder and a layout may have the same name: at the beginning it means the builder, after it the layout.
const Stage& find_stage(std::string_view name, bool at_beginning) {
  const Stage* found = nullptr;
  for (const Stage& stage : stages()) {
    if (stage.name == name && (!found || (stage.kind == StageKind::builder) == at_beginning)) found = &stage;
  }
  if (found) return *found;
  for (const Preset& preset : presets()) {
    if (preset.name != name) continue;
    throw UsageError(fmt::format("'{}' is a whole recipe and stands alone; in a longer one write its stages, '{}'",
                                 name, text_here(preset)));
  }
  std::vector<std::string> names;
  for (const Stage& stage : stages()) names.push_back(stage.name);
  for (const Preset& preset : presets()) names.push_back(preset.name);
  throw UsageError(fmt::format("no recipe stage is called '{}'; {}", name, suggest(name, names)));
}

StageCall parse_call(std::string_view text, std::string_view recipe, bool at_beginning = false) {
  const CallText parts = parse_call_text(text);
  if (parts.name.empty()) {
    throw UsageError(fmt::format("the recipe '{}' has an empty stage; write STAGE > STAGE > …", recipe));
  }
  StageCall call{&find_stage(parts.name, at_beginning), {}};
  call.options = call.stage->defaults;
  set_options(call.stage->options, call.options, parts);
  return call;
}

std::string names_of(StageKind kind) {
  std::vector<std::string> names;
  for (const Stage& stage : stages()) {
    if (stage.kind == kind) names.push_back(stage.name);
  }
  return option_text::join(names, ", ");
}

/// builder > refinement … > layout [> trace], or one peer.
void check_order(const std::vector<StageCall>& calls) {
  const auto fail = [](const std::string& what) { throw UsageError(what); };
  if (calls.front().stage->kind == StageKind::peer) {
    if (calls.size() > 1)
      fail(fmt::format("'{}' builds and traces by itself; nothing can follow it", calls[0].stage->name));
    return;
  }
  if (calls.front().stage->kind != StageKind::builder) {
    fail(fmt::format("a recipe begins with a builder ({}), not with '{}'", names_of(StageKind::builder),
                     calls[0].stage->name));
  }
  bool has_layout = false;
  for (std::size_t i = 1; i < calls.size(); ++i) {
    const Stage& stage = *calls[i].stage;
    switch (stage.kind) {
      case StageKind::builder:
        fail(fmt::format("a recipe has one builder; '{}' is a second one", stage.name));
        break;
      case StageKind::peer:
        fail(fmt::format("'{}' builds and traces by itself; it must stand alone", stage.name));
        break;
      case StageKind::refinement:
        if (has_layout) fail(fmt::format("'{}' changes the tree, so it must stand before the layout", stage.name));
        break;
      case StageKind::layout:
        if (has_layout) fail(fmt::format("a recipe has one layout; '{}' is a second one", stage.name));
        has_layout = true;
        break;
      case StageKind::trace:
        if (!has_layout || i + 1 != calls.size()) fail("'trace' stands once, at the end, after a layout");
        break;
    }
  }
  if (!has_layout) {
    fail(fmt::format("the recipe says how to build but not how to lay out: add one of {}, as in '{} > wide(8)'",
                     names_of(StageKind::layout), calls[0].stage->name));
  }
}

/// Layouts of an octree's cells need a builder that tells them, and nothing that moves nodes in between.
void check_cells(const std::vector<StageCall>& calls) {
  for (std::size_t i = 1; i < calls.size(); ++i) {
    const Stage& stage = *calls[i].stage;
    if (stage.kind != StageKind::layout || !stage.cells) continue;
    if (i == 1 && calls[0].stage->cells) continue;
    throw UsageError(
        fmt::format("'{0}' lays out the cells of an octree, so it must follow 'octree' directly, as in "
                    "'octree > {0}'; '{1}' does not tell any",
                    stage.name, calls[i - 1].stage->name));
  }
}

void check_precision(const std::vector<StageCall>& calls) {
  if (precision_of(calls) == Precision::single_test || walks_wide_nodes(calls)) return;
  throw UsageError(
      "trace(precision=double) goes with the layouts wide(k) and compressed(k) of up to 16 children and no other "
      "option "
      "of 'trace'; change the layout, as in 'binned > wide(8) > trace(precision=double)'");
}

/// Binary trees for wider layouts are collapsed to their width; trees too wide for their layout are refused.
void fit_arity(std::vector<StageCall>& calls) {
  if (calls.front().stage->kind == StageKind::peer) return;
  std::uint32_t arity = 0;
  for (std::size_t i = 0; i < calls.size(); ++i) {
    const Stage& stage = *calls[i].stage;
    if (!stage.arity) continue;
    const std::uint32_t own = stage.arity(calls[i].options);
    if (stage.kind != StageKind::layout) {
      arity = own;
    } else if (arity > own) {
      throw UsageError(
          fmt::format("'{}' holds nodes of at most {} children, but the stages before it make up to {}; "
                      "use a wider layout or a smaller k",
                      stage.name, own, arity));
    } else if (arity == 2 && own > 2) {
      const StageCall collapse = parse_call(fmt::format("collapse({})", own), "collapse");
      calls.insert(calls.begin() + static_cast<std::ptrdiff_t>(i), collapse);
      return;
    }
  }
}

std::string print(const StageCall& call) {
  std::vector<std::string> arguments;
  for (const Option& option : call.stage->options) {
    const std::string value = option.get(call.options);
    if (option.positional) {
      arguments.insert(arguments.begin(), value);
    } else if (value != option.get(call.stage->defaults)) {
      arguments.push_back(option.name + "=" + value);
    }
  }
  return arguments.empty() ? call.stage->name : fmt::format("{}({})", call.stage->name, fmt::join(arguments, ", "));
}

/// Line breaks and tabs are blanks. Other control characters would turn up in messages and reports.
std::string on_one_line(std::string_view text) {
  std::string line(text);
  for (std::size_t i = 0; i < line.size(); ++i) {
    const auto c = static_cast<unsigned char>(line[i]);
    if (c >= 0x20 && c != 0x7f) continue;
    if (c < '\t' || c > '\r') {
      throw UsageError(fmt::format("a recipe has no control characters, but byte {} is {:#04x}; remove it", i, c));
    }
    line[i] = ' ';
  }
  return line;
}

}  // namespace

Recipe::Recipe(std::vector<StageCall> stages)
    : stages_(std::make_shared<const std::vector<StageCall>>(std::move(stages))) {}

Recipe Recipe::parse(std::string_view written) {
  const std::string line = on_one_line(written);
  const std::string_view text = trim(line);
  for (const Preset& preset : presets()) {
    if (text == preset.name) return parse(text_here(preset));
  }
  std::vector<StageCall> calls;
  for (std::string_view rest = text;;) {
    const auto end = rest.find('>');
    calls.push_back(parse_call(rest.substr(0, end), text, calls.empty()));
    if (end == std::string_view::npos) break;
    rest.remove_prefix(end + 1);
  }
  check_order(calls);
  check_cells(calls);
  check_precision(calls);
  fit_arity(calls);
  return Recipe(std::move(calls));
}

std::string Recipe::text() const {
  std::vector<std::string> parts;
  for (const StageCall& call : *stages_) {
    // A trace stage at its defaults says nothing.
    const std::string part = print(call);
    if (call.stage->kind != StageKind::trace || part != call.stage->name) parts.push_back(part);
  }
  return fmt::format("{}", fmt::join(parts, " > "));
}

}  // namespace boxwood
