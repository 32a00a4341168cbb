#pragma once
#include <any>
#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "boxwood/box.h"
#include "cost/cost_model.h"
#include "cost/known_use.h"
#include "options/options.h"

namespace boxwood {

/// What a cost model may know when it is made.
struct CostContext {
  Box scene;                      ///< of everything that is built
  const KnownUse* use = nullptr;  ///< null when nothing is known of the rays to come
};

/// One registry line: a name, where it comes from, its options, and how to make the model for a scene.
struct CostModelEntry {
  std::string name;
  std::string summary;
  std::string source;  ///< paper or study
  std::any defaults;   ///< the options struct as it is when nothing is said
  std::vector<Option> options;
  std::function<bool(const std::any& options)> needs_use;  ///< whether CostContext::use must be known
  std::function<std::unique_ptr<CostModel>(const std::any& options, const CostContext&)> make;
};

/// Every cost model there is; the first is the surface area heuristic. A new one is a line in the table behind this.
const std::vector<CostModelEntry>& cost_models();

/// Which cost model a builder asks, with its options: the value of an option such as cost=rdh(alpha=0.5). By default
/// the surface area heuristic.
class CostChoice {
 public:
  /// Throws UsageError that names the valid ones.
  static CostChoice parse(std::string_view text);
  /// Options at their defaults are left out. parse(text()) gives the same choice.
  std::string text() const;

  bool is_surface_area() const { return entry_ == nullptr; }
  bool needs_use() const;
  /// Throws UsageError when the model must know of the rays to come and nothing is known.
  std::unique_ptr<CostModel> make(const CostContext& context) const;

 private:
  const CostModelEntry* entry_ = nullptr;  ///< null: the first
  std::any options_;
};

/// How recipes list the valid names.
std::string cost_model_names();

/// Describes an option of a stage or of another model that takes a cost model.
template <class T>
void add_cost_choice(OptionsOf<T>& options, std::string name, CostChoice T::*member, std::string help) {
  options.value(
      std::move(name), member, &CostChoice::parse, +[](const CostChoice& choice) { return choice.text(); },
      cost_model_names(), std::move(help));
}

}  // namespace boxwood
