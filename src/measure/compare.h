#pragma once
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "boxwood/ray_set.h"
#include "boxwood/recipe.h"
#include "boxwood/scene.h"
#include "measure/statistics.h"
#include "render/progress.h"

namespace boxwood {

struct CompareSettings {
  std::uint32_t repeats = 11;  ///< timed passes over each ray set
  std::uint32_t warmup = 1;    ///< untimed passes before them
  std::uint32_t threads = 1;   ///< for building and tracing; 1 is timed in CPU time, more in wall time
  std::uint32_t build_repeats = 3;
  double build_seconds = 60;         ///< no further round of builds starts once this much time went into building
  const ExpectedUse* use = nullptr;  ///< as BuildOptions::use
  /// Saved structures of this scene, further contestants after the recipes; their build_ms is the time to load and
  /// verify them.
  std::vector<std::filesystem::path> saved;
};

/// One recipe on one ray set.
struct RayKindRow {
  std::string kind;
  std::uint64_t rays = 0;
  Estimate mrays_per_s;          ///< million rays per second
  Estimate ratio;                ///< speed over the first recipe's in the same repeat; above 1 is faster
  double ratio_p_value = 1;      ///< signed-rank test that the two are equally fast
  std::uint64_t hits = 0;        ///< rays that hit something
  std::uint64_t mismatches = 0;  ///< rays answered otherwise than by the first recipe of our own
  double node_tests_per_ray = 0;
  double primitive_tests_per_ray = 0;
  double steps_per_ray = 0;
  double leaves_per_ray = 0;
};

struct RecipeRow {
  std::string recipe;  ///< canonical text
  std::string file;    ///< of a saved structure; empty: it was built
  bool exact = true;   ///< its hits are those of testing every triangle in single precision, to the bit
  bool peer = false;   ///< not ours: its hits may differ from ours in the last bits
  Estimate build_ms;   ///< wall time
  std::size_t bytes = 0;
  double bytes_per_triangle = 0;  ///< beyond the mesh, per usable unique triangle
  double sah_cost = 0;            ///< 0 for a peer
  std::vector<RayKindRow> rays;   ///< one per ray set, in their order
};

struct Comparison {
  std::string scene;
  std::uint64_t triangles = 0;  ///< placed triangles
  std::vector<RecipeRow> rows;  ///< one per recipe, then one per saved structure; ratios refer to the first
  /// One sentence per recipe and ray set with mismatches; empty when all agree.
  std::vector<std::string> disagreements;
};

/// Builds every recipe, loads what is saved, checks that all answer alike, counts what their rays cost, then times them
/// interleaved. Our own recipes must agree to the bit; a peer must agree on hit or miss and on the distance to a
/// relative 1e-4. Throws UsageError when there is no contestant or ray set, or two sets of one kind; Cancelled when
/// `progress` asks for it.
Comparison compare(const Scene& scene, std::span<const Recipe> recipes, std::span<const RaySet> ray_sets,
                   const CompareSettings& settings = {}, ProgressSink* progress = nullptr);

}  // namespace boxwood
