// A study's result for a terminal.
#include <fmt/format.h>

#include "options/options.h"
#include "report/cell_grid.h"
#include "report/number_text.h"
#include "report/study_report.h"
#include "report/table.h"

namespace boxwood {
namespace {

std::string published_text(const TableSpec& spec) {
  constexpr std::size_t short_enough = 16;
  if (spec.published.empty()) return "";
  if (spec.published.size() > short_enough) return fmt::format("As published: tables/{}-published.csv\n\n", spec.id);
  std::vector<Table::Column> columns;
  for (const std::string& head : spec.published.front()) columns.push_back({head});
  columns.front().align = Align::left;
  Table table(columns);
  for (std::size_t i = 1; i < spec.published.size(); ++i) table.add(spec.published[i]);
  return fmt::format("As published:\n\n{}\n", table.text());
}

std::string table_text(const TableResult& result) {
  const TableSpec& spec = result.spec;
  std::vector<Table::Column> columns;
  for (const std::string& factor : spec.rows) columns.push_back({factor, Align::left});
  const CellGrid grid(result.cells, spec.rows, spec.columns);
  for (const Levels& head : grid.columns()) {
    columns.push_back({head.empty() ? spec.figure.value : option_text::join(head, " ")});
  }
  Table table(columns);
  for (const Levels& row : grid.rows()) {
    std::vector<std::string> cells = row;
    for (const Levels& head : grid.columns()) {
      const Cell* cell = grid.find(row, head);
      cells.push_back(cell ? cell_text(*cell) : "–");
    }
    table.add(std::move(cells));
  }
  return fmt::format("{}\n\n{}\n{}", spec.title, table.text(), published_text(spec));
}

std::string claim_text(const JudgedClaim& claim) {
  std::string out = fmt::format("  {:<4} {:<14} {}\n", claim.spec.id, verdict_name(claim.verdict), claim.spec.text);
  const std::string indent(7, ' ');
  out += fmt::format("{}measured:  {}\n", indent, claim.measured);
  if (!claim.spec.published.empty()) out += fmt::format("{}published: {}\n", indent, claim.spec.published);
  return out;
}

}  // namespace

std::string study_text(const StudyResult& result) {
  std::string out = fmt::format("{}\n", result.study.title);
  if (!result.study.source.empty()) out += fmt::format("After {}\n", result.study.source);
  out += fmt::format("{}; commit {}; {}\n\n", result.environment.cpu, result.environment.commit,
                     counted(result.measurements, "measurement"));
  Table scenes({{"scene", Align::left}, {"triangles"}, {"from", Align::left}});
  for (const SceneFacts& scene : result.scenes) {
    scenes.add({scene.name, grouped(scene.triangles), scene.source + (scene.stand_in ? " (stands in)" : "")});
  }
  out += scenes.text() + "\n";
  for (const TableResult& table : result.tables) {
    if (!table.cells.empty()) out += table_text(table);
  }
  if (!result.claims.empty()) out += "Claims\n\n";
  for (const JudgedClaim& claim : result.claims) out += claim_text(claim);
  if (result.outliers > 0) {
    out += fmt::format("\n{} far off the others of their kind; none was left out.\n",
                       result.outliers == 1 ? "1 sample lies" : fmt::format("{} samples lie", result.outliers));
  }
  return out;
}

}  // namespace boxwood
