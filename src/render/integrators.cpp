#include "render/integrators.h"

#include <fmt/format.h>

#include <algorithm>

#include "options/suggest.h"

namespace boxwood {

std::span<const Integrator> integrators() {
  static const Integrator table[] = {
      eyelight_integrator(), ao_integrator(),   normals_integrator(),
      heatmap_integrator(),  path_integrator(), whitted_integrator(),
  };
  return table;
}

const Integrator& find_integrator(std::string_view name) {
  const auto found = std::ranges::find(integrators(), name, &Integrator::name);
  if (found != integrators().end()) return *found;
  std::vector<std::string> names;
  for (const Integrator& integrator : integrators()) names.emplace_back(integrator.name);
  throw UsageError(fmt::format("unknown integrator '{}': {}", name, suggest(name, names)));
}

}  // namespace boxwood
