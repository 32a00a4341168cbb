#pragma once
#include <functional>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <string_view>

namespace boxwood {

/// Arithmetic on metrics: names, numbers, + - * / and parentheses, as in "(build_ms + trace_ms) / rays". A metric of
/// what the figure is held against is "baseline.NAME".
class Expression {
 public:
  /// Throws UsageError saying where the text stops making sense, or which metric does not exist.
  static Expression parse(std::string_view text);

  /// `value_of` gives nothing for what was not measured; then the result is nothing too.
  using Lookup = std::function<std::optional<double>(const std::string& metric)>;
  std::optional<double> evaluate(const Lookup& value_of, const Lookup& baseline_value_of = {}) const;
  /// Of the figure and of its baseline.
  const std::set<std::string>& metrics() const { return metrics_; }
  bool names_baseline() const { return names_baseline_; }

  struct Node;

 private:
  std::shared_ptr<const Node> root_;
  std::set<std::string> metrics_;
  bool names_baseline_ = false;
};

}  // namespace boxwood
