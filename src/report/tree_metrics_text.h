#pragma once
#include <string>

#include "report/json.h"
#include "structure/tree_metrics.h"

namespace boxwood {

/// End-point overlap, and what lines and each kind of ray cost, as tables.
std::string tree_metrics_text(const TreeMetrics& metrics);
Json to_json(const TreeMetrics& metrics);

}  // namespace boxwood
