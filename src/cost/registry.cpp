#include "cost/registry.h"

#include "cost/scene_interior.h"
#include "cost/surface_area.h"

namespace boxwood {

const std::vector<CostModelEntry>& cost_models() {
  static const std::vector<CostModelEntry> all = {
      {"sah", "rays come from afar, from everywhere alike", "Goldsmith and Salmon 1987; MacDonald and Booth 1990",
       [](const Box&) { return std::make_unique<SurfaceArea>(); }},
      {"interior-fast", "rays start anywhere inside the scene; six overlapping regions",
       "Fabianowski, Flanagan, Dingliana 2009; SAH alternatives study",
       [](const Box& scene) { return std::make_unique<InteriorFast>(scene); }},
      {"interior-hq", "rays start anywhere inside the scene; 26 regions",
       "Fabianowski, Flanagan, Dingliana 2009; SAH alternatives study",
       [](const Box& scene) { return std::make_unique<InteriorHq>(scene); }},
  };
  return all;
}

std::vector<std::string> cost_model_names() {
  std::vector<std::string> names;
  for (const CostModelEntry& entry : cost_models()) names.push_back(entry.name);
  return names;
}

std::unique_ptr<CostModel> make_cost_model(CostChoice choice, const Box& scene) {
  return cost_models()[static_cast<std::size_t>(choice)].make(scene);
}

}  // namespace boxwood
