#pragma once
#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "boxwood/box.h"
#include "cost/cost_model.h"

namespace boxwood {

/// One registry line: a name, where it comes from, and how to make the model for a scene.
struct CostModelEntry {
  std::string name;
  std::string summary;
  std::string source;                                                ///< paper or study
  std::function<std::unique_ptr<CostModel>(const Box& scene)> make;  ///< `scene`: the box of everything that is built
};

/// Which cost model a builder asks: an index into cost_models().
enum class CostChoice : std::uint32_t { sah = 0 };

/// Every cost model there is; the first is the surface area heuristic. A new one is one line here.
const std::vector<CostModelEntry>& cost_models();

/// Their names in that order, as a builder's option `cost` takes them.
std::vector<std::string> cost_model_names();

std::unique_ptr<CostModel> make_cost_model(CostChoice choice, const Box& scene);

}  // namespace boxwood
