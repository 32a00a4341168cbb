#include "comparison_metrics.h"

#include <fmt/format.h>

#include "measure/correlation.h"
#include "report/number_text.h"
#include "report/table.h"
#include "report/tree_metrics_text.h"
#include "structure/object_use.h"
#include "structure/pipeline.h"
#include "workspace.h"

namespace boxwood::cli {
namespace {

constexpr std::uint32_t epo_samples = 20000;

/// Of the recipes whose trees can be seen, in their order.
struct Columns {
  std::vector<const RecipeRow*> rows;
  std::vector<TreeMetrics> metrics;
  std::vector<double> sah, epo, lcv, cost;
};

Columns columns_of(const Scene& scene, const std::vector<Recipe>& recipes, const ExpectedUse& use,
                   const Comparison& comparison) {
  Columns columns;
  const KnownUse known = use_of_mesh(use, scene, 0, {});
  for (std::size_t i = 0; i < recipes.size(); ++i) {
    if (is_peer(recipes[i])) continue;
    const TreeMetrics metrics =
        tree_metrics(tree_of(scene.meshes[0], recipes[i], &known), scene.meshes[0], known, epo_samples);
    columns.rows.push_back(&comparison.rows[i]);
    columns.sah.push_back(comparison.rows[i].sah_cost);
    columns.epo.push_back(metrics.overlap.epo);
    columns.lcv.push_back(metrics.all_rays.lcv);
    columns.cost.push_back(metrics.all_rays.cost);
    columns.metrics.push_back(metrics);
  }
  return columns;
}

/// Nanoseconds per ray of every column.
std::vector<double> times_of(const Columns& columns, std::size_t kind) {
  std::vector<double> times;
  for (const RecipeRow* row : columns.rows) {
    const double speed = row->rays[kind].mrays_per_s.median;
    times.push_back(speed > 0 ? 1000 / speed : 0);
  }
  return times;
}

std::string metrics_table(const Columns& columns) {
  Table table({{"recipe", Align::left}, {"SAH cost"}, {"EPO"}, {"±"}, {"LCV"}, {"cost by rays"}});
  for (std::size_t i = 0; i < columns.rows.size(); ++i) {
    table.add({columns.rows[i]->recipe, significant(columns.sah[i]), significant(columns.epo[i]),
               significant(columns.metrics[i].overlap.standard_error, 2), significant(columns.lcv[i]),
               significant(columns.cost[i])});
  }
  return table.text();
}

std::string two(double pearson_r, double spearman_r) { return fmt::format("{:.2f} / {:.2f}", pearson_r, spearman_r); }

}  // namespace

void check_metrics(const Scene& scene) {
  if (!scene.single_level()) {
    throw UsageError(fmt::format("--metrics takes scenes of one tree; {} has instances", scene.name));
  }
}

ComparisonMetrics comparison_metrics(const Scene& scene, const std::vector<Recipe>& recipes, const ExpectedUse& use,
                                     const Comparison& comparison) {
  const Columns columns = columns_of(scene, recipes, use, comparison);
  ComparisonMetrics out;
  Json trees = Json::array(), correlations = Json::object();
  for (std::size_t i = 0; i < columns.rows.size(); ++i) {
    Json tree = {{"recipe", columns.rows[i]->recipe}, {"sah_cost", columns.sah[i]}};
    tree.update(to_json(columns.metrics[i]));
    trees.push_back(std::move(tree));
  }
  Table table(
      {{"rays", Align::left}, {"SAH cost"}, {"EPO"}, {"LCV"}, {"cost by rays"}, {"(1 - a) SAH + a EPO"}, {"a"}});
  const std::size_t kinds = columns.rows.empty() ? 0 : columns.rows.front()->rays.size();
  for (std::size_t kind = 0; kind < kinds; ++kind) {
    const std::vector<double> times = times_of(columns, kind);
    const FittedBlend fitted = fit_blend(columns.sah, columns.epo, {}, times);
    std::vector<std::string> cells = {columns.rows.front()->rays[kind].kind};
    Json of_kind = Json::object();
    for (const auto& [name, values] : {std::pair("sah_cost", &columns.sah),
                                       {"epo", &columns.epo},
                                       {"leaf_count_variability", &columns.lcv},
                                       {"cost_per_ray", &columns.cost}}) {
      cells.push_back(two(pearson(*values, times), spearman(*values, times)));
      of_kind[name] = {{"pearson", pearson(*values, times)}, {"spearman", spearman(*values, times)}};
    }
    cells.push_back(fmt::format("{:.2f}", fitted.correlation));
    cells.push_back(fmt::format("{:.2f}", fitted.blend.alpha));
    of_kind["fitted_blend"] = {{"alpha", fitted.blend.alpha}, {"pearson", fitted.correlation}};
    correlations[columns.rows.front()->rays[kind].kind] = std::move(of_kind);
    table.add(cells);
  }
  out.text = fmt::format("{}\nCorrelation with the time per ray over {} (Pearson / Spearman):\n\n{}",
                         metrics_table(columns), counted(columns.rows.size(), "tree"), table.text());
  out.json = {{"trees", std::move(trees)}, {"correlations", std::move(correlations)}, {"n", columns.rows.size()}};
  return out;
}

}  // namespace boxwood::cli
