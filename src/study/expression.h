#pragma once
#include <functional>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <string_view>

namespace boxwood {

/// Arithmetic on metrics: names, numbers, + - * / and parentheses, as in "(build_ms + trace_ms) / rays".
class Expression {
 public:
  /// Throws UsageError saying where the text stops making sense, or which metric does not exist.
  static Expression parse(std::string_view text);

  /// `value_of` gives nothing for what was not measured; then the result is nothing too.
  using Lookup = std::function<std::optional<double>(const std::string& metric)>;
  std::optional<double> evaluate(const Lookup& value_of) const;
  const std::set<std::string>& metrics() const { return metrics_; }

  struct Node;

 private:
  std::shared_ptr<const Node> root_;
  std::set<std::string> metrics_;
};

}  // namespace boxwood
