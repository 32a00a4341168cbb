#pragma once
#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "boxwood/recipe.h"
#include "boxwood/scene.h"
#include "measure/clock.h"
#include "measure/statistics.h"
#include "peak_memory.h"
#include "render/progress.h"

namespace boxwood::cli {

struct BuildRow {
  std::string recipe;
  Estimate ns_per_triangle;
  std::optional<PeakMemory> peak;                        ///< beyond the mesh; not measured of peers
  std::vector<std::pair<std::string, Estimate>> ratios;  ///< speed over each peer's in the same round
};

/// How fast recipes build one scene.
struct BuildBench {
  std::string scene;
  std::uint64_t triangles = 0;
  std::vector<BuildRow> rows;
};

struct BuildBenchSettings {
  std::string scene;                 ///< as for load()
  std::vector<std::string> recipes;  ///< ours
  bool peers = false;                ///< also Embree's rtcCommitScene, low and medium, and rtcBuildBVH
  std::uint32_t repeats = 5;
  unsigned threads = 1;
};

/// What build() times, on a clock of our choice: from triangles to a structure that can be traced. The scene has one
/// mesh; the recipe is not a peer's.
double build_seconds(const Scene& scene, const Recipe& recipe, Clock clock);

/// Contestants take turns; each builds the scene's first mesh. Time as clock_for() says. Peak memory is taken in a
/// round of its own.
BuildBench bench_builds(const BuildBenchSettings& settings, ProgressSink& progress);

}  // namespace boxwood::cli
