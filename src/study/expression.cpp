#include "study/expression.h"

#include <fmt/format.h>

#include <cctype>
#include <charconv>

#include "boxwood/error.h"
#include "measure/probe.h"

namespace boxwood {

/// A number, a metric, or an operation on two nodes.
struct Expression::Node {
  char operation = 0;  ///< '+', '-', '*', '/', 'm' for a metric, 'b' for a baseline's, '#' for a number
  double number = 0;
  std::string metric;
  std::shared_ptr<const Node> left, right;
};

namespace {

using NodePointer = std::shared_ptr<const Expression::Node>;

constexpr int deepest = 64;

/// Recursive descent: sum = product {(+|-) product}, product = factor {(*|/) factor}.
class Parser {
 public:
  explicit Parser(std::string_view text) : text_(text) {}

  NodePointer whole() {
    NodePointer root = sum(0);
    if (!rest().empty()) fail();
    return root;
  }

  const std::set<std::string>& metrics() const { return metrics_; }
  bool names_baseline() const { return names_baseline_; }

 private:
  NodePointer sum(int depth) {
    NodePointer left = product(depth);
    for (char c = peek(); c == '+' || c == '-'; c = peek()) {
      take();
      left = operation(c, std::move(left), product(depth));
    }
    return left;
  }

  NodePointer product(int depth) {
    NodePointer left = factor(depth);
    for (char c = peek(); c == '*' || c == '/'; c = peek()) {
      take();
      left = operation(c, std::move(left), factor(depth));
    }
    return left;
  }

  NodePointer factor(int depth) {
    const char c = peek();
    if (c == '(' && depth < deepest) {
      take();
      NodePointer inner = sum(depth + 1);
      if (peek() != ')') fail();
      take();
      return inner;
    }
    if (std::isdigit(static_cast<unsigned char>(c)) || c == '.') return number();
    if (std::isalpha(static_cast<unsigned char>(c))) return metric();
    fail();
  }

  NodePointer number() {
    auto node = std::make_shared<Expression::Node>();
    node->operation = '#';
    const std::string_view tail = rest();
    const auto [end, error] = std::from_chars(tail.data(), tail.data() + tail.size(), node->number);
    if (error != std::errc()) fail();
    at_ += static_cast<std::size_t>(end - tail.data());
    return node;
  }

  NodePointer metric() {
    auto node = std::make_shared<Expression::Node>();
    node->operation = 'm';
    node->metric = name();
    if (node->metric == "baseline" && at_ < text_.size() && text_[at_] == '.') {
      take();
      node->operation = 'b';
      node->metric = name();
      names_baseline_ = true;
    }
    find_metric(node->metric);
    metrics_.insert(node->metric);
    return node;
  }

  std::string name() {
    std::string out;
    rest();
    while (at_ < text_.size() && (std::isalnum(static_cast<unsigned char>(text_[at_])) || text_[at_] == '_')) {
      out += text_[at_++];
    }
    return out;
  }

  static NodePointer operation(char operation, NodePointer left, NodePointer right) {
    auto node = std::make_shared<Expression::Node>();
    node->operation = operation;
    node->left = std::move(left);
    node->right = std::move(right);
    return node;
  }

  std::string_view rest() {
    while (at_ < text_.size() && std::isspace(static_cast<unsigned char>(text_[at_]))) ++at_;
    return text_.substr(at_);
  }
  char peek() { return rest().empty() ? '\0' : text_[at_]; }
  char take() { return text_[at_++]; }

  [[noreturn]] void fail() {
    throw UsageError(fmt::format("'{}' makes no sense from '{}' on; write metrics, numbers, + - * / and parentheses",
                                 text_, rest()));
  }

  std::string_view text_;
  std::size_t at_ = 0;
  std::set<std::string> metrics_;
  bool names_baseline_ = false;
};

std::optional<double> value(const Expression::Node& node, const Expression::Lookup& value_of,
                            const Expression::Lookup& baseline_value_of) {
  if (node.operation == '#') return node.number;
  if (node.operation == 'm') return value_of(node.metric);
  if (node.operation == 'b') return baseline_value_of ? baseline_value_of(node.metric) : std::nullopt;
  const auto left = value(*node.left, value_of, baseline_value_of);
  const auto right = value(*node.right, value_of, baseline_value_of);
  if (!left || !right) return std::nullopt;
  switch (node.operation) {
    case '+':
      return *left + *right;
    case '-':
      return *left - *right;
    case '*':
      return *left * *right;
    default:
      return *right == 0 ? std::nullopt : std::optional(*left / *right);
  }
}

}  // namespace

Expression Expression::parse(std::string_view text) {
  Parser parser(text);
  Expression out;
  out.root_ = parser.whole();
  out.metrics_ = parser.metrics();
  out.names_baseline_ = parser.names_baseline();
  return out;
}

std::optional<double> Expression::evaluate(const Lookup& value_of, const Lookup& baseline_value_of) const {
  return value(*root_, value_of, baseline_value_of);
}

}  // namespace boxwood
