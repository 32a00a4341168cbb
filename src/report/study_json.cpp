// A study's result as one JSON document.
#include <fmt/format.h>

#include "report/study_report.h"
#include "study/run_study.h"

namespace boxwood {
namespace {

Json where_json(const Where& where) {
  Json out = Json::object();
  for (const auto& [factor, levels] : where) out[factor] = levels;
  return out;
}

Json figure_json(const FigureSpec& figure) {
  return {{"value", figure.value},
          {"where", where_json(figure.where)},
          {"baseline", where_json(figure.baseline)},
          {"ratio", is_ratio(figure)},
          {"views", figure.each_view ? "each" : "mean"}};
}

Json cell_json(const Cell& cell) {
  Json out = {{"factors", cell.factors}};
  out.update(to_json(cell.estimate));
  out["mean"] = cell.mean;
  out["members"] = cell.members;
  out["exact"] = cell.exact;
  return out;
}

Json cells_json(const std::vector<Cell>& cells) {
  Json out = Json::array();
  for (const Cell& cell : cells) out.push_back(cell_json(cell));
  return out;
}

/// Where x is a figure, each cell has its own, and says whether it is on the front.
Json plot_cells_json(const PlotResult& plot) {
  Json out = cells_json(plot.cells);
  for (std::size_t i = 0; i < plot.x.size(); ++i) {
    out[i]["x"] = to_json(plot.x[i]);
    if (plot.spec.front) out[i]["front"] = static_cast<bool>(plot.on_front[i]);
  }
  return out;
}

Json plot_json(const PlotResult& plot) {
  const PlotSpec& spec = plot.spec;
  return {{"id", spec.id},
          {"title", spec.title},
          {"kind", spec.kind},
          {"x", spec.x},
          {"x_is_figure", spec.x_is_figure},
          {"series", spec.series},
          {"panels", spec.panels},
          {"x_title", spec.x_title},
          {"y_title", spec.y_title},
          {"log_x", spec.log_x},
          {"log_y", spec.log_y},
          {"figure", figure_json(spec.figure)},
          {"cells", plot_cells_json(plot)}};
}

Json claim_json(const JudgedClaim& claim) {
  Json cells = Json::array();
  for (const JudgedCell& judged : claim.cells) {
    Json cell = cell_json(judged.cell);
    cell["verdict"] = verdict_name(judged.verdict);
    cell["p_value"] = judged.p_value;
    cell["welch_p_value"] = judged.welch_p_value;
    if (judged.versus) cell["versus"] = *judged.versus;
    cells.push_back(std::move(cell));
  }
  return {{"id", claim.spec.id},        {"text", claim.spec.text},           {"verdict", verdict_name(claim.verdict)},
          {"measured", claim.measured}, {"published", claim.spec.published}, {"note", claim.spec.note},
          {"need", claim.spec.need},    {"cells", std::move(cells)}};
}

Json scenes_json(const std::vector<SceneFacts>& scenes) {
  Json out = Json::array();
  for (const SceneFacts& scene : scenes) {
    out.push_back({{"name", scene.name},
                   {"source", scene.source},
                   {"stand_in", scene.stand_in},
                   {"triangles", scene.triangles},
                   {"hash", fmt::format("{:016x}", scene.hash)}});
  }
  return out;
}

Json pictures_json(const std::vector<StoredPicture>& pictures) {
  Json out = Json::array();
  for (const StoredPicture& picture : pictures) {
    out.push_back({{"scene", picture.scene},
                   {"view", picture.view},
                   {"recipe", picture.recipe},
                   {"kind", picture.kind},
                   {"file", "images/" + picture_file_name(picture)}});
  }
  return out;
}

Json run_json(const RunSpec& run) {
  return {{"rays", run.rays},     {"width", run.width},     {"height", run.height}, {"repetitions", run.repetitions},
          {"builds", run.builds}, {"threads", run.threads}, {"seed", run.seed},     {"probes", run.probes},
          {"centre", run.centre}};
}

}  // namespace

Json to_json(const Environment& e) {
  return {{"cpu", e.cpu},       {"threads", e.threads},   {"memory_bytes", e.memory_bytes},
          {"system", e.system}, {"compiler", e.compiler}, {"flags", e.flags},
          {"commit", e.commit}, {"embree", e.embree}};
}

Json to_json(const StudyResult& result) {
  const Study& study = result.study;
  Json recipes = Json::array(), tables = Json::array(), plots = Json::array(), claims = Json::array();
  for (const RecipeSpec& recipe : study.recipes) {
    recipes.push_back({{"label", recipe.label}, {"recipe", recipe.text}, {"factors", recipe.factors}});
  }
  for (const TableResult& table : result.tables) {
    tables.push_back({{"id", table.spec.id},
                      {"title", table.spec.title},
                      {"rows", table.spec.rows},
                      {"columns", table.spec.columns},
                      {"figure", figure_json(table.spec.figure)},
                      {"cells", cells_json(table.cells)},
                      {"published", table.spec.published}});
  }
  for (const PlotResult& plot : result.plots) plots.push_back(plot_json(plot));
  for (const JudgedClaim& claim : result.claims) claims.push_back(claim_json(claim));
  return {{"study", study.name},
          {"title", study.title},
          {"source", study.source},
          {"text", study.text},
          {"quick", study.quick},
          {"claims", std::move(claims)},
          {"scenes", scenes_json(result.scenes)},
          {"recipes", std::move(recipes)},
          {"tables", std::move(tables)},
          {"plots", std::move(plots)},
          {"pictures", pictures_json(result.pictures)},
          {"run", run_json(study.run)},
          {"measurements", result.measurements},
          {"outliers", result.outliers},
          {"environment", to_json(result.environment)}};
}

}  // namespace boxwood
