// The registry lines of the cost models that have options, one per file.
#pragma once
#include "cost/registry.h"

namespace boxwood {

CostModelEntry perspective_entry();
CostModelEntry parallel_entry();
CostModelEntry ray_distribution_entry();
CostModelEntry occlusion_entry();
CostModelEntry overlap_entry();
CostModelEntry blend_entry();

/// Wraps typed functions.
template <class Options>
CostModelEntry cost_model_entry(std::string name, std::string summary, std::string source, OptionsOf<Options> options,
                                bool needs_use,
                                std::unique_ptr<CostModel> (*make)(const Options&, const CostContext&)) {
  return {std::move(name),
          std::move(summary),
          std::move(source),
          Options{},
          options.take(),
          [needs_use](const std::any&) { return needs_use; },
          [make](const std::any& chosen, const CostContext& context) {
            return make(std::any_cast<const Options&>(chosen), context);
          }};
}

}  // namespace boxwood
