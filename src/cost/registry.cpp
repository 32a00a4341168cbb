#include "cost/registry.h"

#include <fmt/format.h>

#include "cost/models.h"
#include "cost/scene_interior.h"
#include "cost/surface_area.h"
#include "options/call.h"

namespace boxwood {
namespace {

struct NoOptions {};

template <class Make>
CostModelEntry entry(std::string name, std::string summary, std::string source, const Make& make) {
  return {std::move(name),
          std::move(summary),
          std::move(source),
          NoOptions{},
          {},
          [](const std::any&) { return false; },
          [make](const std::any&, const CostContext& context) -> std::unique_ptr<CostModel> { return make(context); }};
}

constexpr const char* interior_source = "Fabianowski, Flanagan, Dingliana 2009; SAH alternatives study";

}  // namespace

const std::vector<CostModelEntry>& cost_models() {
  static const std::vector<CostModelEntry> all = {
      entry("sah", "rays come from afar, from everywhere alike", "Goldsmith and Salmon 1987; MacDonald and Booth 1990",
            [](const CostContext&) { return std::make_unique<SurfaceArea>(); }),
      entry("interior-fast", "rays start anywhere inside the scene; six overlapping regions", interior_source,
            [](const CostContext& context) { return std::make_unique<InteriorFast>(context.scene); }),
      entry("interior-hq", "rays start anywhere inside the scene; 26 regions", interior_source,
            [](const CostContext& context) { return std::make_unique<InteriorHq>(context.scene); }),
      perspective_entry(),
      parallel_entry(),
      ray_distribution_entry(),
      occlusion_entry(),
      overlap_entry(),
      blend_entry(),
  };
  return all;
}

std::string cost_model_names() {
  // Not from the table: blend's own line is made of it while the table is.
  return "a cost model";
}

CostChoice CostChoice::parse(std::string_view text) {
  const CallText call = parse_call_text(text);
  std::vector<std::string> names;
  for (const CostModelEntry& entry : cost_models()) {
    names.push_back(entry.name);
    if (entry.name != call.name) continue;
    CostChoice choice;
    if (&entry == &cost_models().front() && call.arguments.empty()) return choice;
    choice.entry_ = &entry;
    choice.options_ = entry.defaults;
    set_options(entry.options, choice.options_, call);
    return choice;
  }
  throw UsageError(fmt::format("takes one of {}, not '{}'", option_text::join(names, ", "), text));
}

std::string CostChoice::text() const {
  if (!entry_) return "sah";
  std::vector<std::string> arguments;
  for (const Option& option : entry_->options) {
    const std::string value = option.get(options_);
    if (option.positional) {
      arguments.push_back(value);
    } else if (value != option.get(entry_->defaults)) {
      arguments.push_back(option.name + "=" + value);
    }
  }
  return arguments.empty() ? entry_->name : fmt::format("{}({})", entry_->name, option_text::join(arguments, ", "));
}

bool CostChoice::needs_use() const { return entry_ && entry_->needs_use(options_); }

std::unique_ptr<CostModel> CostChoice::make(const CostContext& context) const {
  if (!entry_) return cost_models().front().make({}, context);
  if (needs_use() && !context.use) {
    throw UsageError(fmt::format(
        "cost={} must know which rays will be traced and was told nothing; set BuildOptions::use (see expect_use())",
        text()));
  }
  return entry_->make(options_, context);
}

}  // namespace boxwood
