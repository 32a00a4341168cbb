#pragma once
#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace boxwood {

struct StageCall;  // one stage of a recipe with its typed options; internal

/// A parsed pipeline such as "sweep(k=4) > wide(4) > trace(order=near)". Immutable and cheap to copy.
class Recipe {
 public:
  /// Parses a recipe or the name of a preset. Throws UsageError that names the nearest valid stage or option and lists
  /// the valid ones.
  static Recipe parse(std::string_view text);

  /// Canonical text: stages that were implied are written out, options at their default are left out, order is fixed.
  /// parse(text()) gives the same recipe.
  std::string text() const;
  const std::vector<StageCall>& stages() const { return *stages_; }
  friend bool operator==(const Recipe& a, const Recipe& b) { return a.text() == b.text(); }

 private:
  explicit Recipe(std::vector<StageCall> stages);
  std::shared_ptr<const std::vector<StageCall>> stages_;
};

}  // namespace boxwood
