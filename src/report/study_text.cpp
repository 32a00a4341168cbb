// A study's result for a terminal.
#include <fmt/format.h>

#include <algorithm>

#include "options/options.h"
#include "report/number_text.h"
#include "report/study_report.h"
#include "report/table.h"

namespace boxwood {
namespace {

using Levels = std::vector<std::string>;

/// The cell's levels of some factors, in their order.
Levels levels(const Cell& cell, const std::vector<std::string>& factors) {
  Levels out;
  for (const std::string& factor : factors) out.push_back(cell.factors.at(factor));
  return out;
}

std::vector<Levels> distinct(const std::vector<Cell>& cells, const std::vector<std::string>& factors) {
  std::vector<Levels> out;
  for (const Cell& cell : cells) {
    Levels one = levels(cell, factors);
    if (std::ranges::find(out, one) == out.end()) out.push_back(std::move(one));
  }
  return out;
}

std::string cell_text(const Cell& cell) {
  return cell.exact ? significant(cell.estimate.median) : with_interval(cell.estimate);
}

std::string table_text(const TableResult& result) {
  const TableSpec& spec = result.spec;
  std::vector<Table::Column> columns;
  for (const std::string& factor : spec.rows) columns.push_back({factor, Align::left});
  const std::vector<Levels> heads = distinct(result.cells, spec.columns);
  for (const Levels& head : heads) {
    columns.push_back({head.empty() ? spec.figure.value : option_text::join(head, " ")});
  }
  Table table(columns);
  for (const Levels& row : distinct(result.cells, spec.rows)) {
    std::vector<std::string> cells = row;
    for (const Levels& head : heads) {
      const auto found = std::ranges::find_if(result.cells, [&](const Cell& cell) {
        return levels(cell, spec.rows) == row && levels(cell, spec.columns) == head;
      });
      cells.push_back(found == result.cells.end() ? "–" : cell_text(*found));
    }
    table.add(std::move(cells));
  }
  return fmt::format("{}\n\n{}\n", spec.title, table.text());
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
