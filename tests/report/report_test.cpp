#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "report/json.h"
#include "report/number_text.h"
#include "report/progress_bar.h"
#include "report/table.h"

namespace boxwood {
namespace {

TEST(NumberText, Grouped_PutsACommaBetweenEveryThreeDigits) {
  EXPECT_EQ(grouped(0), "0");
  EXPECT_EQ(grouped(999), "999");
  EXPECT_EQ(grouped(1000), "1,000");
  EXPECT_EQ(grouped(std::numeric_limits<std::uint64_t>::max()), "18,446,744,073,709,551,615");
}

TEST(NumberText, Significant_KeepsTheDigitsThatCount) {
  EXPECT_EQ(significant(12.345), "12.3");
  EXPECT_EQ(significant(0.00123456), "0.00123");
  EXPECT_EQ(significant(1234.5), "1,234");
  EXPECT_EQ(significant(9.996), "10.0");
  EXPECT_EQ(significant(-1234567), "-1,234,567");
  EXPECT_EQ(significant(0), "0");
  EXPECT_EQ(significant(1.234e-7), "1.23e-07");
  EXPECT_EQ(significant(std::nan("")), "–");
}

TEST(NumberText, Interval_HasTheDecimalsOfItsMedian) {
  EXPECT_EQ(with_interval({12.345, 11.98765, 13, 11}), "12.3 (12.0–13.0)");
}

TEST(NumberText, Units_FitTheSize) {
  EXPECT_EQ(bytes_text(512), "512 B");
  EXPECT_EQ(bytes_text(2'310'000'000), "2.31 GB");
  EXPECT_EQ(duration_text(0.85), "850 ms");
  EXPECT_EQ(duration_text(12.34), "12.3 s");
  EXPECT_EQ(duration_text(185), "3 min 05 s");
  EXPECT_EQ(counted(1, "ray"), "1 ray");
  EXPECT_EQ(counted(2000, "ray"), "2,000 rays");
}

TEST(Table, Columns_AlignByCharactersNotBytes) {
  Table table({{"näme", Align::left}, {"n"}});
  table.add({"größer", "1"});
  table.add({"日本", "23"});
  table.add({"x"});
  EXPECT_EQ(table.text(),
            "näme     n\n"
            "──────  ──\n"
            "größer   1\n"
            "日本    23\n"
            "x\n");
}

TEST(Table, Markdown_EscapesBars) {
  Table table({{"values", Align::left}, {"n"}});
  table.add({"on | off", "1"});
  EXPECT_EQ(table.markdown(), "| values | n |\n|---|---:|\n| on \\| off | 1 |\n");
}

TEST(ProgressLine, TellsShareAndTimeLeft) {
  EXPECT_EQ(progress_line(0.5, "tracing", 3), "tracing  [===============               ]   50 %  3 s left");
  EXPECT_TRUE(progress_line(0.5, "tracing", 700).ends_with("  12 min left"));
  EXPECT_TRUE(progress_line(0.25, "tracing", 2500).ends_with("  2 h 05 min left"));
  EXPECT_EQ(progress_line(0, "building", 3), "building  [                              ]    0 %");
  EXPECT_EQ(progress_line(1, "building", 3), "building  [==============================]  100 %");
}

TEST(ProgressBar, AsksToStopOnceStopIsSet) {
  std::atomic<bool> stop{false};
  ProgressBar bar(stop);
  EXPECT_TRUE(bar.report(0.1, "working"));
  stop = true;
  EXPECT_FALSE(bar.report(0.2, "working"));
}

TEST(Json, NumbersThatAreNotFinite_BecomeNull) {
  EXPECT_EQ(to_json(Estimate{std::numeric_limits<double>::infinity(), 1, 2, 3}).dump(),
            R"({"median":null,"low":1.0,"high":2.0,"n":3})");
}

}  // namespace
}  // namespace boxwood
