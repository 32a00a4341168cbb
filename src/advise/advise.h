#pragma once
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "advise/trial.h"
#include "measure/compare.h"
#include "render/progress.h"

namespace boxwood {

struct AdviseSettings {
  double seconds = 60;               ///< the search stops about then; building the finalists may take it a little over
  Limits limits;                     ///< of the structure that is recommended; 0: none
  std::uint32_t threads = 1;         ///< to build and trace with
  std::vector<View> views;           ///< where the rays come from, for recipes that ask
  bool exhaustive = false;           ///< measure every candidate on the whole scene, however long it takes
  std::uint32_t repeats = 9;         ///< timed passes of the finalists
  std::uint64_t thin_from = 60'000;  ///< scenes of more triangles are first tried thinned out
  std::uint64_t thin_triangles = 20'000;  ///< to so many
};

/// One round of the search.
struct AdviceRound {
  std::uint64_t triangles = 0;  ///< of the scene it was measured on
  std::size_t rays = 0;
  std::size_t tried = 0, refused = 0, not_reached = 0;
  std::size_t kept = 0;
  double seconds = 0;
};

/// A recipe of the Pareto front, or the reference.
struct AdviceRow {
  RecipeRow measured;        ///< as compare() gives it
  double mrays_per_s = 0;    ///< over all rays together
  double low = 0, high = 0;  ///< from the intervals of the kinds
  bool on_front = false;
};

/// Why the recommended recipe is fast, next to the reference ("default").
struct AdviceReason {
  double epo = 0, sah = 0;  ///< of the largest mesh's tree
  double node_tests_per_ray = 0, primitive_tests_per_ray = 0;
};

struct Advice {
  std::string scene;
  std::uint64_t triangles = 0;
  std::size_t candidates = 0;
  std::vector<AdviceRound> rounds;
  /// Spearman's correlation of the speeds of some recipes on the thinned and on the whole scene; nothing when the scene
  /// was small enough to be taken whole.
  std::optional<double> thin_correlation;
  bool thin_used = false;
  std::vector<AdviceRow> rows;  ///< the finalists, fastest first, and the reference
  std::size_t recommended = 0;  ///< index into rows
  std::size_t reference = 0;    ///< index into rows of "default"
  AdviceReason why, reference_why;
  double blocked_share = 0;  ///< of any-hit rays: how much stands in the way of light
  std::vector<std::string> notes;
  bool interrupted = false;  ///< the rows are the best known when Ctrl-C came
};

/// Searches candidate_recipes() for the fastest on these rays within the limits: by successive halving on interleaved
/// measurements, first on a thinned scene if that orders recipes as the whole scene does (which is measured), then on
/// the whole; the finalists are compared by compare(). Of finalists whose speeds differ by less than 2 % the one that
/// builds fastest is recommended. When `progress` asks to stop, what is known so far is returned as `interrupted`.
/// Throws UsageError without rays, Error when no candidate keeps the limits.
Advice advise(const Scene& scene, std::span<const RaySet> ray_sets, const AdviseSettings& settings = {},
              ProgressSink* progress = nullptr);

/// Ray sets for a scene whose use is not known: primary, shadow, ambient occlusion and diffuse rays (or `kinds`) of
/// cameras in its free space (see free_cameras()), of its own first camera, and of circling ones when there are few.
std::vector<RaySet> rays_to_advise_for(const Scene& scene, std::span<const std::string> kinds, std::uint32_t size,
                                       unsigned threads, std::vector<Camera>& cameras);

}  // namespace boxwood
