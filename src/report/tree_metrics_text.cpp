#include "report/tree_metrics_text.h"

#include <fmt/format.h>

#include "report/number_text.h"
#include "report/table.h"

namespace boxwood {
namespace {

std::string overlap_text(const EndPointOverlap& overlap) {
  std::string epo = significant(overlap.epo, 4);
  if (overlap.standard_error == 0) return epo;
  return fmt::format("{} ± {} (standard error; sampled)", epo, significant(overlap.standard_error, 2));
}

void add_row(Table& table, const std::string& name, const RayCost& cost) {
  table.add({name, grouped(cost.rays), significant(cost.inner_nodes), significant(cost.leaves),
             significant(cost.references), significant(cost.cost), significant(cost.lcv)});
}

Json cost_json(const RayCost& cost) {
  return {{"rays", cost.rays},
          {"inner_nodes_per_ray", cost.inner_nodes},
          {"leaves_per_ray", cost.leaves},
          {"references_per_ray", cost.references},
          {"cost_per_ray", cost.cost},
          {"leaf_count_variability", cost.lcv}};
}

}  // namespace

std::string tree_metrics_text(const TreeMetrics& metrics) {
  Table table({{"every node met up to where rays end", Align::left},
               {"rays"},
               {"inner nodes"},
               {"leaves"},
               {"references"},
               {"cost"},
               {"LCV"}});
  for (const TreeMetrics::OfKind& kind : metrics.rays) add_row(table, kind.kind, kind.cost);
  if (!metrics.rays.empty()) add_row(table, "all of these", metrics.all_rays);
  add_row(table, "uniform lines", metrics.lines);
  return fmt::format("\nEnd-point overlap (EPO): {}\n\n{}", overlap_text(metrics.overlap), table.text());
}

Json to_json(const TreeMetrics& metrics) {
  Json rays = Json::object();
  for (const TreeMetrics::OfKind& kind : metrics.rays) rays[kind.kind] = cost_json(kind.cost);
  return {{"epo", metrics.overlap.epo},
          {"epo_standard_error", metrics.overlap.standard_error},
          {"foreign_area_in_inner_nodes", metrics.overlap.inner_area},
          {"rays", std::move(rays)},
          {"all_rays", cost_json(metrics.all_rays)},
          {"uniform_lines", cost_json(metrics.lines)}};
}

}  // namespace boxwood
