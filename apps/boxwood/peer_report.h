// What bench_against_embree() found, as text and JSON.
#pragma once
#include <string>

#include "peer_bench.h"
#include "report/json.h"

namespace boxwood::cli {

/// One line per column, one column per scene, the geometric mean last.
std::string peer_text(const PeerBench& bench);
/// {"threads", "geometric_means": {column: estimate}, "scenes": [{"name", "triangles", "bytes_per_triangle",
/// "columns"}]}
Json peer_json(const PeerBench& bench);

}  // namespace boxwood::cli
