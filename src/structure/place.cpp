// Structures placed in a structure above them.
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <vector>

#include "boxwood/structure.h"
#include "layout/layout.h"
#include "recipe/capabilities.h"
#include "recipe/stage.h"
#include "structure/instance_paths.h"
#include "structure/mesh_geometry.h"
#include "structure/pipeline.h"
#include "structure/size_limits.h"
#include "structure/threads.h"

namespace boxwood {
namespace {

/// Every level of a batch holds its rays under way on the stack, and threads have some megabytes of that.
constexpr std::uint32_t most_levels = 6;

bool is_peer(const Recipe& recipe) { return recipe.stages().front().stage->kind == StageKind::peer; }

void check_placeable(std::span<const Structure> parts, std::span<const Instance> instances, const Recipe& recipe) {
  check_named(0, instances.size());
  if (is_peer(recipe)) {
    throw UsageError("a peer builds scenes by itself and cannot place structures; use a layout of our own");
  }
  for (std::size_t i = 0; i < parts.size(); ++i) {
    if (precision_of(parts[i].recipe().stages()) == Precision::double_test) {
      throw UsageError(
          fmt::format("part {} is traced in double precision and cannot be placed in another structure, "
                      "because instances map rays in single",
                      i));
    }
    if (!is_peer(parts[i].recipe())) continue;
    throw UsageError(
        fmt::format("part {} was built by the peer '{}' and cannot be placed in another structure; build "
                    "it by a recipe of our own",
                    i, parts[i].recipe().text()));
  }
  for (std::size_t i = 0; i < instances.size(); ++i) {
    if (instances[i].mesh < parts.size()) continue;
    throw UsageError(fmt::format("instance {} places part {}, and there are {}", i, instances[i].mesh, parts.size()));
  }
}

/// Where a structure's leaves lie; empty for one without any.
std::vector<Box> placed_boxes(std::span<const Structure> parts, std::span<const Instance> instances) {
  std::vector<Box> boxes;
  boxes.reserve(instances.size());
  for (const Instance& instance : instances) {
    const Box box = parts[instance.mesh].report().bounds;
    boxes.push_back(box.empty() ? box : instance.object_to_world.box(box));
  }
  return boxes;
}

void add_part(const BuildReport& part, BuildReport& report) {
  report.bytes += part.bytes;
  report.sah_cost += part.sah_cost;
  report.nodes += part.nodes;
  report.primitives += part.primitives;
  report.left_out += part.left_out;
  add_facts(report.facts, part.facts);
}

}  // namespace

Structure place(std::span<const Structure> parts, std::span<const Instance> instances, const Recipe& recipe,
                const BuildOptions& options) {
  check_placeable(parts, instances, recipe);
  std::vector<std::shared_ptr<const InstancePaths>> ways;
  ways.reserve(instances.size());
  for (const Instance& instance : instances) ways.push_back(parts[instance.mesh].paths());
  const auto paths = std::make_shared<const InstancePaths>(std::move(ways));
  if (paths->levels() > most_levels) {
    throw UsageError(
        fmt::format("that makes {} levels of instances, and there can be {}; place what is inside some of "
                    "them directly",
                    paths->levels(), most_levels));
  }
  BuildReport report;
  for (const Structure& part : parts) add_part(part.report(), report);
  std::shared_ptr<const Layout> layout;
  run_on_threads(options.threads, [&] {
    const auto begin = std::chrono::steady_clock::now();
    std::vector<std::shared_ptr<const Layout>> bottoms;
    for (const Structure& part : parts) bottoms.push_back(part.layout());
    Contents contents;
    contents.instances = instances;
    contents.bottoms = bottoms;
    contents.numbers = paths->first_numbers();
    const Pipeline pipeline(recipe);
    pipeline.check_places_whole();
    Tree tree = pipeline.tree({instance_references(placed_boxes(parts, instances)), nullptr, nullptr});
    report.nodes += tree.nodes.size();
    if (!tree.empty()) report.bounds = tree.nodes[0].bounds;
    layout = pipeline.encode(std::move(tree), contents);
    report.build_ms = std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - begin).count();
  });
  report.bytes += layout->bytes();
  add_facts(report.facts, layout->facts());
  return {std::move(layout), std::move(report), recipe, paths};
}

Structure place(std::span<const Structure> parts, std::span<const Instance> instances, std::string_view recipe,
                const BuildOptions& options) {
  return place(parts, instances, Recipe::parse(recipe), options);
}

std::uint32_t Structure::instance_numbers() const { return paths_ ? paths_->numbers() : 1; }

std::vector<std::uint32_t> Structure::instance_path(std::uint32_t instance) const {
  if (instance >= instance_numbers()) {
    throw UsageError(fmt::format("no hit has instance {}; there are {}", instance, instance_numbers()));
  }
  std::vector<std::uint32_t> path;
  if (paths_) paths_->append_path(instance, path);
  return path;
}

}  // namespace boxwood
