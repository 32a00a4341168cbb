#pragma once
#include <cstdint>
#include <functional>
#include <map>
#include <string>
#include <string_view>
#include <tuple>
#include <vector>

#include "store/store.h"
#include "study/expression.h"
#include "study/study.h"

namespace boxwood {

/// A scene as it was measured.
struct SceneFacts {
  std::string name, source;
  std::uint64_t hash = 0, triangles = 0;
  bool stand_in = false;  ///< not the one that the study would rather have
};

/// One figure of one recipe on one scene, for one ray kind and perhaps one view: a sample per repetition.
struct Series {
  Factors factors;  ///< scene, recipe (its label), its own factors; rays and view where the figure has them
  std::vector<double> samples;
};

/// What a store knows about a study: of the scenes that were measured last, with the settings of the study, in one
/// environment.
class Observations {
 public:
  Observations(const Study& study, const Store& store, std::int64_t environment);

  /// One series for every scene, recipe, ray kind (and view) of which all metrics of `value` were measured, in the
  /// order of the study. Without `each_view`, samples are means over the views of a scene. Metrics that are measured
  /// once count for every repetition. Values that depend on no rays have series without ray kinds.
  std::vector<Series> series(const Expression& value, bool each_view) const;

  const std::vector<SceneFacts>& scenes() const { return scenes_; }
  bool empty() const { return scenes_.empty(); }

 private:
  using Samples = std::map<std::string, std::vector<double>>;  ///< by metric, then by repetition

  void add(const Measurement& measurement);
  std::vector<double> samples(const Expression& value, const std::string& scene, const std::string& recipe,
                              const std::string& rays, const std::string& view) const;
  std::vector<double> mean_over_views(const Expression& value, const std::string& scene, const std::string& recipe,
                                      const std::string& rays) const;
  std::vector<std::string> views(const std::string& scene) const;

  const Study& study_;
  std::vector<SceneFacts> scenes_;
  std::map<std::pair<std::string, std::string>, Samples> structures_;                       ///< by scene and recipe
  std::map<std::tuple<std::string, std::string, std::string, std::string>, Samples> rays_;  ///< and rays and view
  std::map<std::string, std::vector<std::string>> views_;                                   ///< by scene
};

/// Whether any metric of `value` is one of ray sets.
bool depends_on_rays(const Expression& value);

/// Whether `factors` has, for each factor in `where`, one of its levels.
bool matches(const Factors& factors, const Where& where);

}  // namespace boxwood
