// Runs a recipe: triangles -> references -> tree -> layout, for one mesh or for two levels.
#include "boxwood/structure.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <optional>
#include <vector>

#include "layout/layout.h"
#include "recipe/stage.h"
#include "structure/instance_paths.h"
#include "structure/mesh_geometry.h"
#include "structure/object_use.h"
#include "structure/opened_instances.h"
#include "structure/pipeline.h"
#include "structure/same_length.h"
#include "structure/size_limits.h"
#include "structure/threads.h"
#include "tree/statistics.h"

namespace boxwood {
namespace {

using Clock = std::chrono::steady_clock;

double milliseconds_since(Clock::time_point begin) {
  return std::chrono::duration<double, std::milli>(Clock::now() - begin).count();
}

/// Adds what it cost to the report. Statistics are taken off the clock.
Tree build_tree(const Pipeline& pipeline, BuildInput input, BuildReport& report) {
  const auto begin = Clock::now();
  Tree tree = input.geometry ? pipeline.mesh_tree(std::move(input)) : pipeline.tree(std::move(input));
  report.build_ms += milliseconds_since(begin);
  report.nodes += tree.nodes.size();
  report.bounds = tree.empty() ? Box{} : tree.nodes[0].bounds;
  return tree;
}

std::shared_ptr<const Layout> encode_level(const Pipeline& pipeline, Tree tree, const Contents& contents,
                                           BuildReport& report) {
  const auto begin_layout = Clock::now();
  auto layout = pipeline.encode(std::move(tree), contents);
  report.build_ms += milliseconds_since(begin_layout);
  report.bytes += layout->bytes();
  add_facts(report.facts, layout->facts());
  return layout;
}

Tree build_mesh_tree(const Mesh& mesh, const Pipeline& pipeline, const KnownUse* use, BuildReport& report) {
  const auto begin = Clock::now();
  const MeshGeometry geometry(mesh);
  BuildInput input{geometry.references(), &geometry, use};
  report.build_ms += milliseconds_since(begin);
  report.primitives += input.references.size();
  report.left_out += mesh.triangles.size() - input.references.size();
  Tree tree = build_tree(pipeline, std::move(input), report);
  report.sah_cost += sah_cost(tree);
  return tree;
}

std::shared_ptr<const Layout> encode_mesh(const Mesh& mesh, Tree tree, const Pipeline& pipeline, BuildReport& report) {
  Contents contents;
  contents.mesh = &mesh;
  return encode_level(pipeline, std::move(tree), contents, report);
}

/// Meshes as they are, or in parts where the recipe says so.
OpenedInstances place_instances(const Scene& scene, std::vector<Tree> trees, const Pipeline& pipeline,
                                BuildReport& report) {
  const auto begin = Clock::now();
  OpenedInstances opened = open_instances(scene, std::move(trees), pipeline.references_per_instance());
  report.build_ms += milliseconds_since(begin);
  return opened;
}

/// Of the parts of instances.
KnownUse use_of_parts(KnownUse of_instances, const OpenedInstances& opened) {
  std::vector<std::uint8_t> seen;
  for (const std::uint32_t number : opened.numbers) seen.push_back(of_instances.seen[number]);
  of_instances.seen = std::move(seen);
  return of_instances;
}

std::shared_ptr<const Layout> build_two_levels(const Scene& scene, const Pipeline& pipeline, const ExpectedUse* use,
                                               BuildReport& report) {
  const std::vector<Box> boxes = instance_boxes(scene);
  std::optional<KnownUse> known;
  const auto known_to = [&](const auto& make) { return use ? &known.emplace(make()) : nullptr; };

  std::vector<Tree> trees;
  for (std::uint32_t m = 0; m < scene.meshes.size(); ++m) {
    const KnownUse* of_mesh = known_to([&] { return use_of_mesh(*use, scene, m, boxes); });
    trees.push_back(build_mesh_tree(scene.meshes[m], pipeline, of_mesh, report));
  }
  OpenedInstances opened = place_instances(scene, std::move(trees), pipeline, report);
  std::vector<std::shared_ptr<const Layout>> bottoms;
  for (std::size_t part = 0; part < opened.parts.size(); ++part) {
    const Mesh& mesh = scene.meshes[opened.mesh_of[part]];
    bottoms.push_back(encode_mesh(mesh, std::move(opened.parts[part]), pipeline, report));
  }
  Contents contents;
  contents.instances = opened.instances;
  contents.bottoms = bottoms;
  contents.numbers = opened.numbers;
  const KnownUse* of_parts = known_to([&] { return use_of_parts(use_of_instances(*use, scene), opened); });
  Tree tree = build_tree(pipeline, {instance_references(opened.boxes), nullptr, of_parts}, report);
  return encode_level(pipeline, std::move(tree), contents, report);
}

/// The use, where the recipe looks at it; null where it does not. Throws UsageError on one that does not fit the scene.
const ExpectedUse* checked_use(const Scene& scene, const Recipe& recipe, const BuildOptions& options) {
  if (!options.use || !needs_use(recipe)) return nullptr;
  for (const ExpectedRays& rays : options.use->rays) check_same_length(rays.rays.size(), rays.ends.size());
  for (const SeenTriangle& seen : options.use->seen) {
    if (seen.instance < scene.instances.size() &&
        seen.primitive < scene.meshes[scene.instances[seen.instance].mesh].triangles.size()) {
      continue;
    }
    throw UsageError(fmt::format("the expected use has seen triangle {} of instance {}, which {} does not have",
                                 seen.primitive, seen.instance, scene.name.empty() ? "the scene" : scene.name));
  }
  return options.use;
}

std::shared_ptr<const Layout> build_peer(const StageCall& peer, const Scene& scene, BuildReport& report) {
  if (std::ranges::any_of(scene.instances, [](const Instance& i) { return i.mask != every_bit; })) {
    throw UsageError("a peer knows no masks of instances; use a layout of our own, such as the preset 'default'");
  }
  const auto begin = Clock::now();
  auto layout = peer.stage->trace_peer(peer.options, scene);
  report.build_ms = milliseconds_since(begin);
  report.bytes = layout->bytes();
  report.primitives = scene.unique_triangles();
  report.bounds = scene.bounds();
  return layout;
}

std::shared_ptr<const InstancePaths> paths_of(const Scene& scene) {
  if (scene.single_level()) return {};
  return std::make_shared<const InstancePaths>(static_cast<std::uint32_t>(scene.instances.size()));
}

}  // namespace

bool needs_use(const Recipe& recipe) {
  return std::ranges::any_of(recipe.stages(), [](const StageCall& call) {
    return call.stage->needs_use && call.stage->needs_use(call.options);
  });
}

Structure build(const Scene& scene, const Recipe& recipe, const BuildOptions& options) {
  for (const Mesh& mesh : scene.meshes) check_named(mesh.triangles.size(), scene.instances.size());
  BuildReport report;
  std::shared_ptr<const Layout> layout;
  run_on_threads(options.threads, [&] {
    const StageCall& first = recipe.stages().front();
    const ExpectedUse* use = checked_use(scene, recipe, options);
    if (first.stage->kind == StageKind::peer) {
      layout = build_peer(first, scene, report);
    } else if (scene.single_level()) {
      std::optional<KnownUse> known;
      if (use) known = use_of_mesh(*use, scene, 0, {});
      const Pipeline pipeline(recipe);
      const Mesh& mesh = scene.meshes.front();
      layout = encode_mesh(mesh, build_mesh_tree(mesh, pipeline, use ? &*known : nullptr, report), pipeline, report);
    } else {
      layout = build_two_levels(scene, Pipeline(recipe), use, report);
    }
  });
  return {std::move(layout), std::move(report), recipe, paths_of(scene)};
}

Structure build(const Scene& scene, std::string_view recipe, const BuildOptions& options) {
  return build(scene, Recipe::parse(recipe), options);
}

}  // namespace boxwood
