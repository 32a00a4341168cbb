// Tables that the reader can sort.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "options/options.h"
#include "report/cell_grid.h"
#include "report/html/markup.h"
#include "report/html/sections.h"

namespace boxwood::html {
namespace {

/// "k = 4, mode = binary or k-way", escaped.
std::string where_text(const Where& where) {
  std::string out;
  for (const auto& [factor, levels] : where) {
    out += fmt::format("{}{} = {}", out.empty() ? "" : ", ", factor, option_text::join(levels, " or "));
  }
  return escaped(out);
}

/// Ratios are coloured where their whole interval is on one side of 1, the stronger the further they are from it: a
/// heat map, whose darkest shade is a factor of 4.
std::string cell_attributes(const Cell& cell, bool ratio) {
  constexpr double darkest = 4;
  const Estimate& e = cell.estimate;
  if (!ratio || cell.exact || (e.low <= 1 && e.high >= 1)) return "class=\"n\"";
  const double strength = std::min(1.0, std::abs(std::log(e.median)) / std::log(darkest));
  return fmt::format("class=\"n {}\" style=\"--heat:{:.0f}%\"", e.low > 1 ? "up" : "down", 100 * strength);
}

std::string cell_html(const Cell* cell, bool ratio) {
  if (!cell) return "<td class=\"n\">–</td>";
  return fmt::format("<td {} data-v=\"{}\" title=\"mean {:.6g}, n = {}, {} averaged\">{}</td>",
                     cell_attributes(*cell, ratio), cell->estimate.median, cell->mean, cell->estimate.n, cell->members,
                     escaped(cell_text(*cell)));
}

/// What the original printed, folded away where it is long.
/// Whether the cells of a published column are figures, which line up at the right, or words.
bool is_figures(const std::vector<std::vector<std::string>>& rows, std::size_t column) {
  return std::all_of(rows.begin() + 1, rows.end(), [&](const std::vector<std::string>& row) {
    const std::string cell = column < row.size() ? row[column] : "";
    return cell.empty() || cell == "N/A" || cell.find_first_of("0123456789") <= 1;  // perhaps after a sign
  });
}

std::string published_html(const TableSpec& spec) {
  if (spec.published.empty()) return "";
  constexpr std::size_t short_enough = 8;
  std::string out =
      fmt::format("<details{}><summary>As published</summary><div class=\"wide\"><table class=\"sortable\">",
                  spec.published.size() <= short_enough ? " open" : "");
  for (std::size_t i = 0; i < spec.published.size(); ++i) {
    out += i == 0 ? "<thead><tr>" : "<tr>";
    for (std::size_t k = 0; k < spec.published[i].size(); ++k) {
      const char* tag = i == 0 || k == 0 ? "th" : "td";
      const char* style = is_figures(spec.published, k) ? " class=\"n\"" : "";
      out += fmt::format("<{0}{1}>{2}</{0}>", tag, style, escaped(spec.published[i][k]));
    }
    out += i == 0 ? "</tr></thead><tbody>\n" : "</tr>\n";
  }
  return out + "</tbody></table></div></details>";
}

std::string table_html(const TableResult& result, const std::string& prefix) {
  const TableSpec& spec = result.spec;
  const bool ratio = is_ratio(spec.figure);
  const CellGrid grid(result.cells, spec.rows, spec.columns);
  std::string out = fmt::format(
      "<figure id=\"{}-table-{}\"><figcaption><h3>{}</h3><p>{}</p></figcaption><div class=\"wide\">"
      "<table class=\"sortable\"><thead><tr>",
      prefix, escaped(spec.id), escaped(spec.title.empty() ? spec.id : spec.title), figure_note(spec.figure));
  for (const std::string& factor : spec.rows) out += fmt::format("<th>{}</th>", escaped(factor));
  for (const Levels& head : grid.columns()) {
    out += fmt::format("<th class=\"n\">{}</th>",
                       escaped(head.empty() ? spec.figure.value : option_text::join(head, " · ")));
  }
  out += "</tr></thead><tbody>\n";
  for (const Levels& row : grid.rows()) {
    out += "<tr>";
    for (const std::string& level : row) out += fmt::format("<th>{}</th>", escaped(level));
    for (const Levels& head : grid.columns()) out += cell_html(grid.find(row, head), ratio);
    out += "</tr>\n";
  }
  return out + "</tbody></table></div>" + published_html(spec) + "</figure>\n";
}

}  // namespace

std::string figure_note(const FigureSpec& figure) {
  std::string out = fmt::format("<code>{}</code>", escaped(figure.value));
  if (is_ratio(figure)) {
    out += fmt::format(", as a ratio: {} over this, above 1 is less than there", where_text(figure.baseline));
  } else if (!figure.baseline.empty()) {
    out += fmt::format(", where baseline is {}", where_text(figure.baseline));
  }
  if (!figure.where.empty()) out += fmt::format("; {}", where_text(figure.where));
  return out;
}

std::string tables_section(const StudyResult& result, const std::string& prefix) {
  std::string out;
  for (const TableResult& table : result.tables) {
    if (!table.cells.empty()) out += table_html(table, prefix);
  }
  return out.empty() ? out : fmt::format("<section id=\"{}-tables\"><h2>Tables</h2>\n{}</section>\n", prefix, out);
}

}  // namespace boxwood::html
