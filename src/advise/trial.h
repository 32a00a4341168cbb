#pragma once
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "boxwood/expected_use.h"
#include "boxwood/ray_set.h"
#include "boxwood/recipe.h"
#include "boxwood/scene.h"
#include "measure/statistics.h"
#include "render/progress.h"

namespace boxwood {

/// How one recipe did in a round. Not measured at all when it was refused or time ran out.
struct Trial {
  Recipe recipe;
  bool measured = false;
  std::string refused;  ///< why it could not be built; empty otherwise
  double build_ms = 0;
  std::size_t bytes = 0;
  Estimate ratio;  ///< its speed over all rays, in that of the reference in the same repeat
};

struct TrialSettings {
  std::uint32_t repeats = 3;
  std::uint32_t threads = 1;           ///< 1 is timed in CPU time, more in wall time
  std::size_t batch_bytes = 1u << 30;  ///< structures that are held at once, roughly
  double deadline = 0;                 ///< on Clock::wall; after it no recipe is built but the first few. 0: none
  const ExpectedUse* use = nullptr;
};

/// Builds the recipes in batches and times each batch interleaved with one and the same reference structure, so that
/// speeds from different batches compare. A recipe's time is that of all rays together. In the caller's TBB arena.
/// Throws Cancelled when `progress` asks for it.
std::vector<Trial> run_trials(const Scene& scene, std::span<const Recipe> recipes, const Structure& reference,
                              std::span<const RaySet> ray_sets, const TrialSettings& settings,
                              ProgressSink* progress = nullptr);

/// Recipes that no other beats at once in speed, build time and bytes, by their numbers; fastest first.
std::vector<Trial> pareto_front(std::span<const Trial> trials);

/// The `count` trials that a further round should look at: most of them the fastest, the rest the fastest others that
/// are on the Pareto front. Those over a limit (0: none) come never. Fastest first.
struct Limits {
  double build_ms = 0;
  double bytes = 0;
};
std::vector<Trial> survivors(std::span<const Trial> trials, std::size_t count, const Limits& limits);

}  // namespace boxwood
