// Arithmetic on metrics.
#include "study/expression.h"

#include <gtest/gtest.h>

#include <map>

#include "boxwood/error.h"

namespace boxwood::testing {
namespace {

std::optional<double> evaluate(const std::string& text, const std::map<std::string, double>& values = {}) {
  return Expression::parse(text).evaluate([&](const std::string& metric) -> std::optional<double> {
    const auto found = values.find(metric);
    return found == values.end() ? std::nullopt : std::optional(found->second);
  });
}

TEST(Expression, FollowsThePrecedenceOfArithmetic) {
  EXPECT_EQ(evaluate("2 + 3 * 4"), 14);
  EXPECT_EQ(evaluate("(2 + 3) * 4"), 20);
  EXPECT_EQ(evaluate("10 - 4 - 3"), 3);
  EXPECT_EQ(evaluate("16 / 4 / 2"), 2);
  EXPECT_EQ(evaluate("1e3 * .5"), 500);
}

TEST(Expression, LooksMetricsUp) {
  EXPECT_EQ(evaluate("build_ms + trace_ms / 2", {{"build_ms", 1}, {"trace_ms", 4}}), 3);
  EXPECT_EQ(Expression::parse("(trace_ms+build_ms)/trace_ms").metrics(),
            (std::set<std::string>{"build_ms", "trace_ms"}));
}

TEST(Expression, NamesMetricsOfItsBaseline) {
  const Expression gain = Expression::parse("(baseline.trace_ms - trace_ms) / build_ms");
  EXPECT_TRUE(gain.names_baseline());
  EXPECT_EQ(gain.metrics(), (std::set<std::string>{"build_ms", "trace_ms"}));
  const auto own = [](const std::string& metric) { return std::optional(metric == "trace_ms" ? 4.0 : 2.0); };
  EXPECT_EQ(gain.evaluate(own, [](const std::string&) { return std::optional(10.0); }), 3);
  EXPECT_EQ(gain.evaluate(own), std::nullopt);
  EXPECT_FALSE(Expression::parse("trace_ms").names_baseline());
  for (const char* text : {"baseline", "baseline.", "baseline.nothing", "baseline trace_ms"}) {
    EXPECT_THROW(Expression::parse(text), UsageError) << text;
  }
}

TEST(Expression, OfWhatIsMissingOrOverZero_IsNothing) {
  EXPECT_EQ(evaluate("build_ms + 1"), std::nullopt);
  EXPECT_EQ(evaluate("1 / hits", {{"hits", 0}}), std::nullopt);
}

TEST(Expression, ThatMakesNoSense_IsRefused) {
  for (const char* text : {"", "1 +", "(1", "1)", "1 2", "build_ms trace_ms", "*2", "$"}) {
    EXPECT_THROW(Expression::parse(text), UsageError) << text;
  }
  EXPECT_THROW(Expression::parse(std::string(1000, '(')), UsageError);
}

TEST(Expression, WithAnUnknownMetric_NamesTheNearest) {
  try {
    Expression::parse("trace_mss");
    ADD_FAILURE();
  } catch (const UsageError& error) {
    EXPECT_NE(std::string(error.what()).find("'trace_ms'"), std::string::npos) << error.what();
  }
}

}  // namespace
}  // namespace boxwood::testing
