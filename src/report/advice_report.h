#pragma once
#include <string>

#include "advise/advise.h"
#include "report/json.h"

namespace boxwood {

/// The Pareto front as a table, the recommendation, why it is fast, and the lines of C++ that use it. `scene` is what
/// the user calls the scene.
std::string advice_text(const Advice& advice, const std::string& scene);
Json to_json(const Advice& advice);

}  // namespace boxwood
