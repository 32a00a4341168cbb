// The page that people pass on: complete, safe to open, and in need of nothing else.
#include "report/html/html_report.h"

#include <gtest/gtest.h>

#include "report/html/axis.h"
#include "report/html/markup.h"

namespace boxwood {
namespace {

Cell cell(const Factors& factors, double median, double low, double high) {
  Cell out;
  out.factors = factors;
  out.members = 1;
  out.estimate = {.median = median, .low = low, .high = high, .n = 7};
  out.mean = median;
  return out;
}

StudyResult made_up() {
  StudyResult result;
  result.study.name = "made-up";
  result.study.title = "Is <script>alert(1)</script> & \"this\" safe?";
  result.study.source = "A paper, https://example.org/paper";
  result.study.quick = true;
  result.study.file_text = "title = \"x\"\n";
  result.environment.cpu = "A <fast> machine";
  result.environment.commit = "abc123";
  result.scenes = {{.name = "knot", .source = "generate:knot", .hash = 1, .triangles = 1234, .stand_in = true}};
  const std::vector<Cell> cells = {cell({{"k", "4"}, {"rays", "ao"}}, 12.25, 11.5, 13.75),
                                   cell({{"k", "8"}, {"rays", "ao"}}, 21.5, 20.25, 23.5)};
  TableSpec table;
  table.id = table.title = "times";
  table.figure.value = "trace_ms";
  table.rows = {"k"};
  table.columns = {"rays"};
  table.published = {{"k", "ao & more", "remark"}, {"4", "12.5", "slow"}};
  result.tables.push_back({table, cells});
  for (const char* kind : {"line", "bar", "scatter"}) {
    PlotSpec plot;
    plot.id = plot.title = plot.kind = kind;
    plot.figure.value = "trace_ms";
    plot.x = "k";
    plot.panels = {"rays"};
    result.plots.push_back({plot, cells, {}, {}});
  }
  for (const Verdict verdict : {Verdict::holds, Verdict::does_not_hold, Verdict::inconclusive, Verdict::not_run}) {
    JudgedClaim claim;
    claim.spec.id = std::string("C-") + std::string(verdict_name(verdict));
    claim.spec.text = "Claim <b>" + claim.spec.id;
    claim.spec.published = "published " + claim.spec.id;
    claim.measured = "measured " + claim.spec.id;
    claim.spec.each = {"k", "rays"};
    claim.verdict = verdict;
    if (verdict != Verdict::not_run)
      claim.cells = {
          {.cell = cells.front(), .verdict = verdict, .p_value = 0.0125, .welch_p_value = 0.02, .versus = {}}};
    result.claims.push_back(claim);
  }
  result.pictures = {{"made-up", "knot", "0", "", "rendering", {1, 2, 3}},
                     {"made-up", "knot", "0", "wide <8>", "heatmap", {1, 2, 3, 4}}};
  return result;
}

std::string page() {
  const StudyResult result = made_up();
  return html_report(std::span(&result, 1));
}

std::size_t count(const std::string& text, const std::string& part) {
  std::size_t found = 0;
  for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++found;
  return found;
}

TEST(HtmlReport, EveryClaim_HasItsVerdictAndBothNumbers) {
  const std::string html = page();
  for (const JudgedClaim& claim : made_up().claims) {
    EXPECT_EQ(count(html, "id=\"s0-claim-" + claim.spec.id + "\""), 1u) << claim.spec.id;
    EXPECT_EQ(count(html, "measured " + claim.spec.id), 1u) << claim.spec.id;
    EXPECT_EQ(count(html, "published " + claim.spec.id), 1u) << claim.spec.id;
  }
  for (const char* words : {"✓ holds", "✗ does not hold", "? inconclusive", "– not run"})
    EXPECT_GE(count(html, words), 1u);
}

TEST(HtmlReport, EveryFigure_IsInItsTableAndInEveryPlotWithItsInterval) {
  const std::string html = page();
  EXPECT_EQ(count(html, "data-v=\"21.5\""), 1u);
  EXPECT_EQ(count(html, ">21.5 (20.2–23.5)</td>"), 1u);
  EXPECT_EQ(count(html, "k 8: 21.5 (20.2–23.5)</title>"), 3u);
  EXPECT_EQ(count(html, "<svg "), 3u);
  EXPECT_EQ(count(html, "class=\"whisker\""), 3u * 2u * 3u);  // three lines for each of two figures
}

TEST(HtmlReport, TwoFigures_AreAPointWithBothIntervalsAndTheFrontIsNamed) {
  StudyResult result = made_up();
  PlotResult plot = result.plots.back();
  plot.spec.x = "bytes / primitives";
  plot.spec.x_is_figure = true;
  plot.spec.x_title = "bytes per triangle";
  plot.spec.series = {"k"};
  plot.x = {{.median = 60, .low = 59, .high = 61, .n = 7}, {.median = 7, .low = 7, .high = 7, .n = 7}};
  plot.on_front = {false, true};
  result.plots = {plot};
  const std::string html = html_report(std::span(&result, 1));
  EXPECT_EQ(count(html, "4; bytes per triangle: 60.0 (59.0–61.0); "), 1u);
  EXPECT_EQ(count(html, "class=\"whisker\""), 3u * 3u);  // of the second point x is exact
  EXPECT_EQ(count(html, "class=\"ring\""), 1u);
  EXPECT_EQ(count(html, "class=\"name"), 1u);
}

TEST(HtmlReport, EveryPicture_IsInThePage) {
  const std::string html = page();
  EXPECT_EQ(count(html, "src=\"data:image/png;base64,AQID\""), 1u);
  EXPECT_EQ(count(html, "src=\"data:image/png;base64,AQIDBA==\""), 1u);
}

TEST(HtmlReport, PublishedTables_StandBesideOurs) {
  const std::string html = page();
  EXPECT_EQ(count(html, "As published"), 1u);
  EXPECT_NE(html.find("<th class=\"n\">ao &amp; more</th>"), std::string::npos);
  EXPECT_NE(html.find("<td class=\"n\">12.5</td><td>slow</td>"), std::string::npos);  // figures right, words left
}

TEST(HtmlReport, TextOfOthers_IsNeverMarkup) {
  const std::string html = page();
  EXPECT_EQ(count(html, "<script>"), 1u);  // our own
  EXPECT_EQ(html.find("<fast>"), std::string::npos);
  EXPECT_EQ(html.find("Claim <b>"), std::string::npos);
  EXPECT_NE(html.find("heatmap: wide &lt;8&gt;"), std::string::npos);
  EXPECT_EQ(html::escaped("<a b=\"c\" d='e'>&"), "&lt;a b=&quot;c&quot; d=&#39;e&#39;&gt;&amp;");
}

TEST(HtmlReport, Page_AsksForNothingElse) {
  const std::string html = page();
  for (const char* request : {"src=\"http", "href=\"http", "src=\"/", "<link", "@import", "url(", "fetch("}) {
    EXPECT_EQ(html.find(request), std::string::npos) << request;
  }
  EXPECT_NE(html.find("default-src 'none'"), std::string::npos);
}

TEST(HtmlReport, HowToRepeatIt_IsThere) {
  const std::string html = page();
  EXPECT_NE(html.find("boxwood study made-up.toml --quick --out study-made-up"), std::string::npos);
  EXPECT_NE(html.find("git checkout abc123"), std::string::npos);
}

TEST(HtmlReport, StudyWithoutResults_IsAPageStill) {
  StudyResult empty;
  empty.study.title = "Nothing yet";
  EXPECT_NE(html_report(std::span(&empty, 1)).find("Nothing yet"), std::string::npos);
}

TEST(Axis, AllValues_LieBetweenItsEnds) {
  for (const bool logarithmic : {false, true}) {
    for (const auto& [low, high] : {std::pair(0.93, 1.31), std::pair(3.0, 3.0), std::pair(2.0, 4e7)}) {
      const html::Axis axis = html::axis_over(low, high, logarithmic);
      EXPECT_LE(axis.low, low);
      EXPECT_GE(axis.high, high);
      EXPECT_FALSE(axis.ticks.empty()) << low << " " << high;
      EXPECT_LE(axis.at(low), axis.at(high));
    }
  }
}

}  // namespace
}  // namespace boxwood
