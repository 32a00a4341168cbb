#pragma once
#include <nlohmann/json.hpp>
#include <span>

#include "boxwood/recipe.h"
#include "boxwood/scene.h"
#include "measure/compare.h"
#include "measure/statistics.h"
#include "recipe/stage.h"
#include "render/render.h"
#include "scene/generators.h"
#include "scene/scene_sources.h"
#include "tree/statistics.h"

namespace boxwood {

/// Members stay in the order in which they were added. Names are spelled out and end in their unit; measured figures
/// are {"median", "low", "high", "n"}; numbers that are not finite become null.
using Json = nlohmann::ordered_json;

Json to_json(const Estimate& estimate);
/// A figure that was measured once.
Json measured_once(double value);

/// {"name", "triangles", "rows": [{"recipe", "build_ms", "bytes_per_triangle", "sah_cost", "rays": {KIND: {…}}}]}
Json to_json(const Comparison& comparison);
Json to_json(const TreeStatistics& statistics);
Json to_json(const ImportNotes& notes);
/// The entry of a camera sidecar.
Json to_json(const Camera& camera);
/// {KIND: {"query", "rays", "hits", "trace_ms", "mrays_per_s"}}; CPU time of all threads, the rate is that of one.
Json to_json(std::span<const RayKindReport> ray_kinds);
/// {"closest_hit": {"rays", "hits", "trace_ms", "mrays_per_s"}, "any_hit": {…}}: the same, summed by query.
Json totals_by_query(std::span<const RayKindReport> ray_kinds);
Json to_json(std::span<const Stage> stages, std::span<const Preset> presets);
Json to_json(std::span<const Generator> generators, std::span<const SceneSource> sources);

/// Rays per second of one thread, in millions; 0 when none were traced.
double mrays_per_s(const RayKindReport& report);

}  // namespace boxwood
