// A study's result as a folder of files.
#include <fmt/format.h>

#include "files/output_file.h"
#include "report/csv.h"
#include "report/study_report.h"

namespace boxwood {
namespace {

namespace fs = std::filesystem;

void write(const fs::path& file, const std::string& text) {
  OutputFile out(file);
  out.write(text);
  out.commit();
}

/// A further column: what it is called, and what it says of each cell.
struct CsvColumn {
  std::string name;
  std::vector<std::string> fields;
};

/// One line per cell: its factors in the order given, then its figures, then `more`.
std::string cells_csv(const std::vector<Cell>& cells, const std::vector<std::string>& factors, const FigureSpec& figure,
                      const std::vector<CsvColumn>& more = {}) {
  std::vector<std::string> head = factors;
  for (const char* name : {"figure", "median", "low", "high", "mean", "n", "members"}) head.emplace_back(name);
  for (const CsvColumn& column : more) head.push_back(column.name);
  std::string out = csv_line(head);
  const std::string name = is_ratio(figure) ? fmt::format("speedup in {}", figure.value) : figure.value;
  for (std::size_t i = 0; i < cells.size(); ++i) {
    const Cell& cell = cells[i];
    std::vector<std::string> line;
    line.reserve(head.size());
    for (const std::string& factor : factors) line.push_back(cell.factors.at(factor));
    line.push_back(name);
    for (const double x : {cell.estimate.median, cell.estimate.low, cell.estimate.high, cell.mean}) {
      line.push_back(csv_number(x));
    }
    line.push_back(std::to_string(cell.estimate.n));
    line.push_back(std::to_string(cell.members));
    for (const CsvColumn& column : more) line.push_back(column.fields[i]);
    out += csv_line(line);
  }
  return out;
}

std::vector<std::string> joined(std::vector<std::string> a, const std::vector<std::string>& b) {
  a.insert(a.end(), b.begin(), b.end());
  return a;
}

std::string plot_csv(const PlotResult& plot) {
  std::vector<std::string> factors = joined(plot.spec.panels, plot.spec.series);
  if (!plot.spec.x_is_figure) {
    factors.push_back(plot.spec.x);
    return cells_csv(plot.cells, factors, plot.spec.figure);
  }
  CsvColumn x{plot.spec.x, {}}, front{"front", {}};
  for (std::size_t i = 0; i < plot.cells.size(); ++i) {
    x.fields.push_back(csv_number(plot.x[i].median));
    front.fields.emplace_back(plot.on_front[i] ? "1" : "0");
  }
  return cells_csv(plot.cells, factors, plot.spec.figure, {x, front});
}

std::string claims_csv(const std::vector<JudgedClaim>& claims) {
  std::string out = csv_line({"id", "verdict", "measured", "published", "text"});
  for (const JudgedClaim& claim : claims) {
    out += csv_line({claim.spec.id, std::string(verdict_name(claim.verdict)), claim.measured, claim.spec.published,
                     claim.spec.text});
  }
  return out;
}

void make_folder(const fs::path& folder) {
  std::error_code error;
  fs::create_directories(folder, error);
  if (error) throw Error(fmt::format("the folder {} cannot be made: {}", folder.string(), error.message()));
}

}  // namespace

std::string picture_file_name(const StoredPicture& picture) {
  std::string out;
  for (const std::string* part : {&picture.scene, &picture.kind, &picture.recipe}) {
    if (!out.empty() && !part->empty()) out += '-';
    for (const char c : *part) {
      const bool plain = (c >= '0' && c <= '9') || (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z');
      if (plain) {
        out += c;
      } else if (!out.ends_with('-')) {
        out += '-';
      }
    }
  }
  return out + ".png";
}

void write_study(const fs::path& folder, const StudyResult& result) {
  for (const char* name : {"tables", "plots", "images"}) make_folder(folder / name);
  for (const TableResult& table : result.tables) {
    write(folder / "tables" / (table.spec.id + ".csv"),
          cells_csv(table.cells, joined(table.spec.rows, table.spec.columns), table.spec.figure));
    if (table.spec.published.empty()) continue;
    std::string published;
    for (const std::vector<std::string>& row : table.spec.published) published += csv_line(row);
    write(folder / "tables" / (table.spec.id + "-published.csv"), published);
  }
  for (const PlotResult& plot : result.plots) {
    write(folder / "plots" / (plot.spec.id + ".csv"), plot_csv(plot));
  }
  for (const StoredPicture& picture : result.pictures) {
    OutputFile out(folder / "images" / picture_file_name(picture));
    out.write(std::as_bytes(std::span(picture.png)));
    out.commit();
  }
  write(folder / "claims.csv", claims_csv(result.claims));
  write(folder / (result.study.name + ".toml"), result.study.file_text);
  write(folder / "result.json", to_json(result).dump(2, ' ', false, Json::error_handler_t::replace) + "\n");
}

}  // namespace boxwood
