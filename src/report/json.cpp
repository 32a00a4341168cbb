#include "report/json.h"

#include "cost/registry.h"
#include "recipe/capabilities.h"
#include "report/catalog_text.h"

namespace boxwood {
namespace {

Json ray_kind_json(const RayKindRow& row) {
  return {{"rays", row.rays},
          {"mrays_per_s", to_json(row.mrays_per_s)},
          {"ratio", to_json(row.ratio)},
          {"ratio_p_value", row.ratio_p_value},
          {"hits", row.hits},
          {"mismatches", row.mismatches},
          {"node_tests_per_ray", row.node_tests_per_ray},
          {"primitive_tests_per_ray", row.primitive_tests_per_ray},
          {"steps_per_ray", row.steps_per_ray},
          {"leaves_per_ray", row.leaves_per_ray}};
}

Json options_json(std::span<const Option> options, const std::any& defaults) {
  Json out = Json::array();
  for (const Option& option : options) {
    out.push_back({{"name", option.name},
                   {"default", option.get(defaults)},
                   {"values", option.values},
                   {"positional", option.positional},
                   {"help", option.help}});
  }
  return out;
}

const char* query_name(Query query) { return query == Query::closest_hit ? "closest_hit" : "any_hit"; }

Json traced_json(const RayKindReport& report) {
  return {{"rays", report.rays},
          {"hits", report.hits},
          {"trace_ms", measured_once(report.trace_seconds * 1000)},
          {"mrays_per_s", measured_once(mrays_per_s(report))}};
}

}  // namespace

Json to_json(const Estimate& estimate) {
  return {{"median", estimate.median}, {"low", estimate.low}, {"high", estimate.high}, {"n", estimate.n}};
}

Json measured_once(double value) { return to_json(Estimate{value, value, value, 1}); }

Json to_json(const Comparison& comparison) {
  Json rows = Json::array();
  for (const RecipeRow& row : comparison.rows) {
    Json rays = Json::object();
    for (const RayKindRow& kind : row.rays) rays[kind.kind] = ray_kind_json(kind);
    rows.push_back({{"recipe", row.recipe},
                    {"file", row.file.empty() ? Json() : Json(row.file)},
                    {"peer", row.peer},
                    {"build_ms", to_json(row.build_ms)},
                    {"bytes", row.bytes},
                    {"bytes_per_triangle", row.bytes_per_triangle},
                    {"sah_cost", row.sah_cost},
                    {"rays", rays}});
  }
  return {{"name", comparison.scene},
          {"triangles", comparison.triangles},
          {"rows", rows},
          {"disagreements", comparison.disagreements}};
}

Json to_json(const TreeStatistics& statistics) {
  return {{"inner_nodes", statistics.inner_nodes},
          {"leaves", statistics.leaves},
          {"references", statistics.references},
          {"max_depth", statistics.max_depth},
          {"mean_leaf_depth", statistics.mean_leaf_depth},
          {"max_arity", statistics.max_arity},
          {"mean_arity", statistics.mean_arity},
          {"leaf_sizes", statistics.leaf_sizes},
          {"arities", statistics.arities},
          {"sah_traversal_constant", statistics.constants.traversal},
          {"sah_intersection_constant", statistics.constants.intersection},
          {"sah_cost", statistics.sah_cost},
          {"sibling_overlap", statistics.sibling_overlap},
          {"tree_bytes", statistics.bytes}};
}

Json to_json(const ImportNotes& notes) {
  return {{"degenerate_triangles", notes.degenerate_triangles},
          {"non_finite_triangles", notes.non_finite_triangles},
          {"messages", notes.messages}};
}

Json to_json(const Camera& camera) {
  const auto list = [](const Vec3& v) { return Json{v.x, v.y, v.z}; };
  Json out = {{"name", camera.name},
              {"eye", list(camera.eye)},
              {"direction", list(camera.direction)},
              {"up", list(camera.up)},
              {"fov", camera.fov}};
  if (camera.mirrored) out["mirrored"] = true;
  if (camera.width > 0) out["size"] = {camera.width, camera.height};
  return out;
}

double mrays_per_s(const RayKindReport& report) {
  return report.trace_seconds > 0 ? static_cast<double>(report.rays) / report.trace_seconds * 1e-6 : 0;
}

Json to_json(std::span<const RayKindReport> ray_kinds) {
  Json out = Json::object();
  for (const RayKindReport& report : ray_kinds) {
    out[report.kind] = {{"query", query_name(report.query)}};
    out[report.kind].update(traced_json(report));
  }
  return out;
}

Json totals_by_query(std::span<const RayKindReport> ray_kinds) {
  Json out = Json::object();
  for (const Query query : {Query::closest_hit, Query::any_hit}) {
    RayKindReport total;
    for (const RayKindReport& report : ray_kinds) {
      if (report.query != query) continue;
      total.rays += report.rays;
      total.hits += report.hits;
      total.trace_seconds += report.trace_seconds;
    }
    out[query_name(query)] = traced_json(total);
  }
  return out;
}

Json to_json(std::span<const Stage> stages, std::span<const Preset> presets) {
  Json stage_list = Json::array();
  for (const Stage& stage : stages) {
    Json entry = {{"name", stage.name},
                  {"kind", stage_kind_name(stage.kind)},
                  {"summary", stage.summary},
                  {"source", stage.source},
                  {"options", options_json(stage.options, stage.defaults)}};
    if (answers_queries(stage)) {
      entry["queries"] = Json::array();
      for (const CapabilityEntry& query : capabilities()) {
        if (has_capability(stage, query.capability)) entry["queries"].push_back(query.name);
      }
    }
    stage_list.push_back(std::move(entry));
  }
  Json preset_list = Json::array();
  for (const Preset& preset : presets) {
    preset_list.push_back({{"name", preset.name},
                           {"recipe", preset.text},
                           {"recipe_avx512", preset.text_avx512.empty() ? preset.text : preset.text_avx512},
                           {"summary", preset.summary}});
  }
  Json cost_list = Json::array();
  for (const CostModelEntry& model : cost_models()) {
    cost_list.push_back({{"name", model.name},
                         {"summary", model.summary},
                         {"source", model.source},
                         {"options", options_json(model.options, model.defaults)}});
  }
  return {{"stages", stage_list}, {"cost_models", cost_list}, {"presets", preset_list}};
}

Json to_json(std::span<const Generator> generators, std::span<const SceneSource> sources) {
  Json generator_list = Json::array();
  for (const Generator& generator : generators) {
    generator_list.push_back({{"name", generator.name},
                              {"summary", generator.summary},
                              {"options", options_json(generator.options, generator.defaults)}});
  }
  Json source_list = Json::array();
  for (const SceneSource& source : sources) {
    source_list.push_back({{"package", source.package},
                           {"installer", source.installer},
                           {"path", source.path},
                           {"summary", source.summary},
                           {"triangles", source.triangles},
                           {"readable", source.readable},
                           {"installed", is_installed(source)}});
  }
  return {{"generators", generator_list}, {"packages", source_list}};
}

}  // namespace boxwood
