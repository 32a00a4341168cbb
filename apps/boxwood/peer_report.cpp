#include "peer_report.h"

#include <fmt/format.h>

#include <algorithm>

#include "report/number_text.h"
#include "report/table.h"

namespace boxwood::cli {

std::string peer_text(const PeerBench& bench) {
  std::vector<Table::Column> columns = {{"column", Align::left}};
  for (const PeerSceneBench& scene : bench.scenes) columns.push_back({scene.scene});
  columns.push_back({"geometric mean"});
  Table table(columns);
  for (const auto& [name, mean] : bench.geometric_means) {
    std::vector<std::string> cells = {name};
    for (const PeerSceneBench& scene : bench.scenes) {
      const auto column = std::ranges::find(scene.columns, name, &PeerColumn::name);
      cells.push_back(column == scene.columns.end() ? "–" : significant(column->ratio.median));
    }
    cells.push_back(with_interval(mean));
    table.add(std::move(cells));
  }
  const std::string threads = bench.threads == 1   ? "one thread"
                              : bench.threads == 0 ? "all threads"
                                                   : fmt::format("{} threads", bench.threads);
  std::string out = fmt::format("Boxwood / best Embree configuration, {}:\n\n{}\n", threads, table.text());
  for (const PeerSceneBench& scene : bench.scenes) {
    out += fmt::format("{}: {}; bytes per triangle", scene.scene, counted(scene.triangles, "triangle"));
    for (const auto& [preset, bytes] : scene.bytes_per_triangle) out += fmt::format(", {} {:.1f}", preset, bytes);
    out += "\n";
  }
  return out;
}

Json peer_json(const PeerBench& bench) {
  Json means = Json::object();
  for (const auto& [name, mean] : bench.geometric_means) means[name] = to_json(mean);
  Json scenes = Json::array();
  for (const PeerSceneBench& scene : bench.scenes) {
    Json columns = Json::object();
    for (const PeerColumn& column : scene.columns) {
      Json entry = {{"ratio", to_json(column.ratio)}, {"recipe", column.ours}, {"peer", column.peer}};
      if (column.rays > 0) entry["rays"] = column.rays, entry["mismatches"] = column.mismatches;
      columns[column.name] = std::move(entry);
    }
    Json bytes = Json::object();
    for (const auto& [preset, value] : scene.bytes_per_triangle) bytes[preset] = measured_once(value);
    scenes.push_back({{"name", scene.scene},
                      {"triangles", scene.triangles},
                      {"bytes_per_triangle", std::move(bytes)},
                      {"columns", std::move(columns)}});
  }
  return {{"threads", bench.threads}, {"geometric_means", std::move(means)}, {"scenes", std::move(scenes)}};
}

}  // namespace boxwood::cli
