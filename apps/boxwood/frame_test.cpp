#include "frame_test.h"

#include <fmt/format.h>

#include <algorithm>
#include <numeric>

#include "boxwood/ray_set.h"
#include "console.h"
#include "layout/slab/slab_planes.h"
#include "measure/clock.h"
#include "measure/trace_rays.h"
#include "recipe/stage.h"
#include "render/camera_rays.h"
#include "structure/pipeline.h"
#include "trace/leaf_triangle.h"
#include "tree/statistics.h"
#include "workspace.h"

namespace boxwood::cli {
namespace {

/// Pixels in 16 x 16 blocks along the Morton curve, so that 4, 8 or 16 neighbours in the list are a block in the
/// picture.
RaySet primary_rays_in_blocks(const RenderSettings& settings) {
  constexpr std::uint32_t side = 16;
  const CameraRays camera(settings.camera, settings.width, settings.height, 1, settings.seed);
  const auto even_bits = [](std::uint32_t code) {
    return (code & 1) | (code >> 1 & 2) | (code >> 2 & 4) | (code >> 3 & 8);
  };
  RaySet set;
  set.kind = "primary";
  for (std::uint32_t top = 0; top < settings.height; top += side) {
    for (std::uint32_t left = 0; left < settings.width; left += side) {
      for (std::uint32_t code = 0; code < side * side; ++code) {
        const std::uint32_t x = left + even_bits(code), y = top + even_bits(code >> 1);
        if (x < settings.width && y < settings.height) set.rays.push_back(camera.ray(x, y, 0));
      }
    }
  }
  return set;
}

template <class Work>
std::vector<double> timed(std::uint32_t frames, const Work& work) {
  std::vector<double> seconds;
  for (std::uint32_t i = 0; i < frames; ++i) {
    check_interrupt();
    const double begin = now(Clock::wall);
    work();
    seconds.push_back(now(Clock::wall) - begin);
  }
  return seconds;
}

std::string walk_of(const Recipe& recipe) {
  TraceOptions trace;
  for (const StageCall& call : recipe.stages()) {
    if (call.stage->kind == StageKind::peer) return "its own";
    if (call.stage->kind == StageKind::trace) trace = std::any_cast<const TraceOptions&>(call.options);
  }
  constexpr const char* orders[] = {"unordered", "ordered by axis", "ordered by distance"};
  return fmt::format("{}, {}", trace.mode == TraversalMode::iterative ? "iterative" : "recursive",
                     orders[static_cast<std::size_t>(trace.order)]);
}

bool has_slabs(const Recipe& recipe) {
  return std::ranges::any_of(recipe.stages(), [](const StageCall& call) { return call.stage->name == "slab"; });
}

void describe_tree(const Scene& scene, const Recipe& recipe, FrameTest& test) {
  if (is_peer(recipe) || !scene.single_level()) return;
  const Tree tree = tree_of(scene.meshes[0], recipe);
  const TreeStatistics known = statistics(tree);
  test.tree_height = known.max_depth;
  test.inner_nodes = known.inner_nodes;
  test.leaf_nodes = known.leaves;
  test.node_bytes -= std::min<std::uint64_t>(test.node_bytes, known.references * sizeof(LeafTriangle));
  if (has_slabs(recipe)) test.surface_ratio = slab_fit(tree).surface_ratio;
}

std::string times_text(const char* what, const FrameTimes& times) {
  return fmt::format(
      "first {0} time: {1:.6f}\nlast {0} time: {2:.6f}\nminimum {0} time: {3:.6f}\naverage {0} time: {4:.6f}\n"
      "maximum {0} time: {5:.6f}\n",
      what, times.first, times.last, times.least, times.mean, times.most);
}

}  // namespace

FrameTimes::FrameTimes(const std::vector<double>& seconds) {
  if (seconds.empty()) return;
  first = seconds.front(), last = seconds.back();
  least = *std::ranges::min_element(seconds), most = *std::ranges::max_element(seconds);
  mean = std::accumulate(seconds.begin(), seconds.end(), 0.0) / static_cast<double>(seconds.size());
}

FrameTest test_frames(const Scene& scene, const Recipe& recipe, const RenderSettings& settings, std::uint32_t frames,
                      unsigned threads) {
  FrameTest test;
  test.recipe = recipe.text(), test.scene = scene.name;
  test.triangles = scene.placed_triangles();
  test.bounds = scene.bounds();
  test.width = settings.width, test.height = settings.height, test.frames = frames, test.threads = threads;
  const Structure structure = build(scene, recipe, {.threads = threads});
  test.build_seconds = structure.report().build_ms / 1000;
  test.node_bytes = structure.report().bytes;
  test.walk = walk_of(recipe);
  describe_tree(scene, recipe, test);

  const RaySet rays = primary_rays_in_blocks(settings);
  Answers answers(rays);
  test.traversal = FrameTimes(timed(frames, [&] { trace_rays(structure, rays, answers); }));
  test.raytrace = FrameTimes(timed(frames, [&] { render(scene, structure, settings); }));
  if (!is_peer(recipe)) {
    const CounterTotals totals = count_tests(structure, rays);
    const auto count = static_cast<double>(rays.rays.size());
    test.node_tests = static_cast<double>(totals.node_tests) / count;
    test.triangle_tests = static_cast<double>(totals.primitive_tests) / count;
  }
  return test;
}

std::string report_text(const FrameTest& test) {
  const auto point = [](const Vec3& p) { return fmt::format("({:.7g},{:.7g},{:.7g})", p.x, p.y, p.z); };
  std::string out = "Test\n";
  out += fmt::format("acceleration method: {}\nmodel file: {}\nnumber of triangles: {}\n", test.recipe, test.scene,
                     test.triangles);
  out += fmt::format("scene extends: min{} max{}\n", point(test.bounds.lower), point(test.bounds.upper));
  out += fmt::format("resolution: {}x{}\nthreads: {}\nnumber of frames: {}\n", test.width, test.height, test.threads,
                     test.frames);
  out += fmt::format("construction time: {:.6f}\ntree height: {}\ninner node count: {}\nleaf node count: {}\n",
                     test.build_seconds, test.tree_height, test.inner_nodes, test.leaf_nodes);
  out += fmt::format("computed memory usage of nodes: {}\n", test.node_bytes);
  if (test.surface_ratio > 0) {
    out += fmt::format("average node surface ratio approx/real: {:.5f}\n", test.surface_ratio);
  }
  out +=
      fmt::format("traversal algorithm: {}\naverage node intersections per ray: {:.4f}\n", test.walk, test.node_tests);
  out += fmt::format("average triangle intersections per ray: {:.5f}\n", test.triangle_tests);
  return out + times_text("traversal", test.traversal) + times_text("raytrace", test.raytrace);
}

}  // namespace boxwood::cli
