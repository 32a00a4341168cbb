// Runs a recipe: triangles -> references -> tree -> layout, for one mesh or for two levels.
#include "boxwood/structure.h"

#include <fmt/format.h>
#include <tbb/global_control.h>
#include <tbb/task_arena.h>

#include <chrono>
#include <optional>

#include "build/build_input.h"
#include "layout/layout.h"
#include "recipe/stage.h"
#include "structure/mesh_geometry.h"
#include "tree/statistics.h"

namespace boxwood {
namespace {

/// The stages of a recipe that work on trees, run on one input after the other.
class Pipeline {
 public:
  explicit Pipeline(const Recipe& recipe) {
    for (const StageCall& call : recipe.stages()) {
      if (call.stage->kind == StageKind::builder) builder_ = &call;
      if (call.stage->kind == StageKind::refinement) refinements_.push_back(&call);
      if (call.stage->kind == StageKind::layout) layout_ = &call;
      if (call.stage->kind == StageKind::trace) trace_ = std::any_cast<const TraceOptions&>(call.options);
    }
  }

  std::shared_ptr<const Layout> run(BuildInput input, const Contents& contents, BuildReport& report) const {
    Tree tree = builder_->stage->build(builder_->options, std::move(input));
    for (const StageCall* call : refinements_) tree = call->stage->refine(call->options, std::move(tree));
    report.sah_cost += sah_cost(tree);
    report.nodes += tree.nodes.size();
    return layout_->stage->encode(layout_->options, std::move(tree), contents, trace_);
  }

 private:
  const StageCall* builder_ = nullptr;
  std::vector<const StageCall*> refinements_;
  const StageCall* layout_ = nullptr;
  TraceOptions trace_;
};

std::shared_ptr<const Layout> build_bottom(const Mesh& mesh, const Pipeline& pipeline, BuildReport& report) {
  const MeshGeometry geometry(mesh);
  BuildInput input{geometry.references(), &geometry};
  report.primitives += input.references.size();
  report.left_out += mesh.triangles.size() - input.references.size();
  Contents contents;
  contents.mesh = &mesh;
  return pipeline.run(std::move(input), contents, report);
}

std::shared_ptr<const Layout> build_two_levels(const Scene& scene, const Pipeline& pipeline, BuildReport& report) {
  std::vector<std::shared_ptr<const Layout>> bottoms(scene.meshes.size());
  std::vector<Box> boxes(scene.meshes.size());
  std::size_t bytes = 0;
  for (std::size_t m = 0; m < scene.meshes.size(); ++m) {
    boxes[m] = usable_bounds(scene.meshes[m]);
    bottoms[m] = build_bottom(scene.meshes[m], pipeline, report);
    bytes += bottoms[m]->bytes();
  }
  BuildInput input{instance_references(scene, boxes), nullptr};
  Contents contents;
  contents.instances = scene.instances;
  contents.bottoms = bottoms;
  BuildReport top;  // costs of the two levels do not add up; the report speaks of the triangles
  auto layout = pipeline.run(std::move(input), contents, top);
  report.nodes += top.nodes;
  report.bytes = bytes + layout->bytes();
  return layout;
}

void check_same_length(std::size_t rays, std::size_t answers) {
  if (rays != answers) throw UsageError(fmt::format("{} rays need as many answers, not {}", rays, answers));
}

}  // namespace

Structure build(const Scene& scene, const Recipe& recipe, const BuildOptions& options) {
  BuildReport report;
  std::shared_ptr<const Layout> layout;
  const auto work = [&] {
    const StageCall& first = recipe.stages().front();
    if (first.stage->kind == StageKind::peer) {
      layout = first.stage->trace_peer(first.options, scene);
      report.bytes = layout->bytes();
      for (const Mesh& mesh : scene.meshes) report.primitives += mesh.triangles.size();
    } else if (scene.single_level()) {
      layout = build_bottom(scene.meshes.front(), Pipeline(recipe), report);
      report.bytes = layout->bytes();
    } else {
      layout = build_two_levels(scene, Pipeline(recipe), report);
    }
  };
  const auto begin = std::chrono::steady_clock::now();
  tbb::task_arena arena(options.threads == 0 ? tbb::task_arena::automatic : static_cast<int>(options.threads));
  arena.execute(work);
  report.build_ms = std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - begin).count();
  return {std::move(layout), report, recipe};
}

Structure build(const Scene& scene, std::string_view recipe, const BuildOptions& options) {
  return build(scene, Recipe::parse(recipe), options);
}

Structure::Structure(std::shared_ptr<const Layout> layout, BuildReport report, Recipe recipe)
    : layout_(std::move(layout)), report_(report), recipe_(std::move(recipe)) {}

Hit Structure::closest_hit(const Ray& ray) const { return layout_->closest_hit(ray); }

bool Structure::any_hit(const Ray& ray) const { return layout_->any_hit(ray); }

void Structure::closest_hits(std::span<const Ray> rays, std::span<Hit> hits) const {
  check_same_length(rays.size(), hits.size());
  layout_->closest_hits(rays, hits);
}

void Structure::any_hits(std::span<const Ray> rays, std::span<std::uint8_t> blocked) const {
  check_same_length(rays.size(), blocked.size());
  layout_->any_hits(rays, blocked);
}

void Structure::closest_hits_counted(std::span<const Ray> rays, std::span<Hit> hits,
                                     std::span<RayCounters> counters) const {
  check_same_length(rays.size(), hits.size());
  check_same_length(rays.size(), counters.size());
  layout_->closest_hits_counted(rays, hits, counters);
}

void Structure::any_hits_counted(std::span<const Ray> rays, std::span<std::uint8_t> blocked,
                                 std::span<RayCounters> counters) const {
  check_same_length(rays.size(), blocked.size());
  check_same_length(rays.size(), counters.size());
  layout_->any_hits_counted(rays, blocked, counters);
}

}  // namespace boxwood
