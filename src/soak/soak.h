#pragma once
#include <cstdint>
#include <map>
#include <span>
#include <string>
#include <vector>

#include "boxwood/ray.h"
#include "boxwood/recipe.h"
#include "boxwood/scene.h"
#include "boxwood/structure.h"
#include "render/progress.h"

namespace boxwood {

struct SoakSettings {
  std::uint64_t seed = 1;
  std::uint64_t first = 0;  ///< number of the first case
  std::uint64_t cases = 0;  ///< at most; 0: as many as there is time for
  double seconds = 30;
  std::uint32_t rays = 200;  ///< per case
};

/// A case that went wrong. `number` and the seed make it again.
struct SoakFailure {
  std::uint64_t number = 0;
  std::string scene, recipe, what;
};

struct SoakResult {
  std::uint64_t cases = 0, rays = 0;
  std::map<std::string, std::uint64_t> refusals;  ///< sentences with which builds were refused, and how often
  std::vector<SoakFailure> failures;              ///< at most 20
};

/// Asks every query of a structure, alone, in a batch and counted. Returns what differs from testing every triangle of
/// `scene`, to the bit; empty when nothing does.
std::string find_difference(const Structure& structure, const Scene& scene, std::span<const Ray> rays);

/// As above for what the recipe builds over the scene, and again after saving and loading where its layout can be
/// saved. `refused` takes the sentence with which a build was refused.
std::string find_disagreement(const Scene& scene, const Recipe& recipe, std::span<const Ray> rays,
                              std::string& refused);

/// Random recipe x random scene x random rays, until the time or the cases are over. A case depends on the seed and its
/// number only. Throws Cancelled when `progress` asks for it.
SoakResult soak(const SoakSettings& settings, ProgressSink* progress = nullptr);

}  // namespace boxwood
