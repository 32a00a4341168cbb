// Structures over triangles in double precision.
#include "boxwood/precise.h"

#include <fmt/format.h>

#include <chrono>
#include <cmath>
#include <limits>
#include <utility>

#include "layout/precise/precise_kernels.h"
#include "layout/precise/precise_level.h"
#include "recipe/capabilities.h"
#include "structure/frames.h"
#include "structure/pipeline.h"
#include "structure/same_length.h"
#include "structure/size_limits.h"
#include "structure/threads.h"
#include "tree/statistics.h"

namespace boxwood {
namespace {

LargeVector<PreciseTriangle> usable_triangles(std::span<const DoubleVec3> vertices,
                                              std::span<const Triangle> triangles) {
  LargeVector<PreciseTriangle> out;
  out.reserve(triangles.size());
  for (std::uint32_t i = 0; i < triangles.size(); ++i) {
    for (const std::uint32_t vertex : triangles[i]) {
      if (vertex < vertices.size()) continue;
      throw Error(
          fmt::format("triangle {} refers to vertex {} of {}; indices count from 0", i, vertex, vertices.size()));
    }
    if (const auto triangle = precise_triangle(vertices, triangles[i], i)) out.push_back(*triangle);
  }
  return out;
}

/// Of a frame, in world space. Conversions of doubles beyond the range of floats give infinities.
Box world_bounds(const PreciseFrameTree& frame) {
  constexpr float infinity = std::numeric_limits<float>::infinity();
  const Box& box = frame.tree.nodes[0].bounds;
  Box out;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const auto world = [&](float x) { return frame.center[axis] + static_cast<double>(x) / frame.scale; };
    out.lower[axis] = std::nextafter(static_cast<float>(world(box.lower[axis])), -infinity);
    out.upper[axis] = std::nextafter(static_cast<float>(world(box.upper[axis])), infinity);
  }
  return out;
}

}  // namespace

PreciseStructure::PreciseStructure(std::shared_ptr<const PreciseLevel> level, BuildReport report, Recipe recipe)
    : level_(std::move(level)),
      kernels_(precise_kernels(level_->k)),
      report_(std::move(report)),
      recipe_(std::move(recipe)) {}

PreciseHit PreciseStructure::closest_hit(const PreciseRay& ray) const {
  return kernels_->closest(*level_, ray, nullptr);
}

bool PreciseStructure::any_hit(const PreciseRay& ray) const { return kernels_->any(*level_, ray, nullptr); }

void PreciseStructure::closest_hits(std::span<const PreciseRay> rays, std::span<PreciseHit> hits) const {
  check_same_length(rays.size(), hits.size());
  kernels_->closest_batch(*level_, rays, hits);
}

void PreciseStructure::any_hits(std::span<const PreciseRay> rays, std::span<std::uint8_t> blocked) const {
  check_same_length(rays.size(), blocked.size());
  kernels_->any_batch(*level_, rays, blocked);
}

void PreciseStructure::closest_hits_counted(std::span<const PreciseRay> rays, std::span<PreciseHit> hits,
                                            std::span<RayCounters> counters) const {
  check_same_length(rays.size(), hits.size());
  check_same_length(rays.size(), counters.size());
  for (std::size_t i = 0; i < rays.size(); ++i) {
    counters[i] = {};
    hits[i] = kernels_->closest(*level_, rays[i], &counters[i]);
  }
}

std::size_t PreciseStructure::frames() const { return level_->frames.size(); }

PreciseStructure build_precise(std::span<const DoubleVec3> vertices, std::span<const Triangle> triangles,
                               const Recipe& recipe, const BuildOptions& options) {
  if (!walks_wide_nodes(recipe.stages())) {
    throw UsageError(
        fmt::format("'{}' cannot trace triangles in double precision: they need the layout wide(k) or compressed(k) "
                    "under the default walk",
                    recipe.text()));
  }
  check_named(triangles.size(), 0);
  BuildReport report;
  std::shared_ptr<const PreciseLevel> level;
  run_on_threads(options.threads, [&] {
    const auto begin = std::chrono::steady_clock::now();
    LargeVector<PreciseTriangle> usable = usable_triangles(vertices, triangles);
    report.primitives = usable.size();
    report.left_out = triangles.size() - usable.size();
    const double reach = reach_of(usable);
    std::vector<PreciseFrameTree> frames = build_frames(std::move(usable), Pipeline(recipe));
    for (const PreciseFrameTree& frame : frames) {
      report.nodes += frame.tree.nodes.size();
      report.sah_cost += sah_cost(frame.tree);
    }
    if (!frames.empty()) report.bounds = world_bounds(frames[0]);
    level = std::make_shared<const PreciseLevel>(encode_precise_level(frames, reach));
    report.build_ms = std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - begin).count();
  });
  report.bytes = level->bytes();
  return {std::move(level), std::move(report), recipe};
}

PreciseStructure build_precise(std::span<const DoubleVec3> vertices, std::span<const Triangle> triangles,
                               std::string_view recipe, const BuildOptions& options) {
  return build_precise(vertices, triangles, Recipe::parse(recipe), options);
}

}  // namespace boxwood
