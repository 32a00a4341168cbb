#pragma once
// Layouts encoded straight from trees, without recipes or builders.
#include <memory>
#include <string>
#include <vector>

#include "layout/stages.h"
#include "support/trees.h"

namespace boxwood::test {

/// A layout stage with options set by "name=value" text.
struct LayoutCall {
  Stage stage;
  std::any options;

  explicit LayoutCall(Stage of) : stage(std::move(of)), options(stage.defaults) {}
  LayoutCall& set(const std::string& name, const std::string& value) {
    for (const Option& option : stage.options) {
      if (option.name == name) option.set(options, value);
    }
    return *this;
  }
  std::string name() const { return stage.name + "(" + std::to_string(stage.arity(options)) + ")"; }
};

/// Encodes a scene on one level or two. `marks` as in SplitTreeOptions.
inline std::shared_ptr<const Layout> encode_scene(const Scene& scene, const LayoutCall& call, const TraceOptions& trace,
                                                  std::uint32_t leaf_size = 2, bool marks = true) {
  const SplitTreeOptions split{call.stage.arity(call.options), leaf_size, marks};
  const auto encode_mesh = [&](const Mesh& mesh) {
    Contents contents;
    contents.mesh = &mesh;
    return call.stage.encode(call.options, split_tree(triangle_boxes(mesh), split), contents, trace);
  };
  if (scene.single_level()) return encode_mesh(scene.meshes[0]);
  std::vector<std::shared_ptr<const Layout>> bottoms;
  std::vector<Box> mesh_boxes, boxes;
  for (const Mesh& mesh : scene.meshes) {
    bottoms.push_back(encode_mesh(mesh));
    mesh_boxes.emplace_back();
    for (const Box& box : triangle_boxes(mesh)) mesh_boxes.back().grow(box);
  }
  for (const Instance& i : scene.instances) boxes.push_back(i.object_to_world.box(mesh_boxes[i.mesh]));
  Contents contents;
  contents.instances = scene.instances;
  contents.bottoms = bottoms;
  return call.stage.encode(call.options, split_tree(boxes, {split.k, 1, marks}), contents, trace);
}

/// What the closest hits of all rays cost together.
inline RayCounters total_cost(const Layout& layout, const std::vector<Ray>& rays) {
  std::vector<Hit> hits(rays.size());
  std::vector<RayCounters> counters(rays.size());
  layout.closest_hits_counted(rays, hits, counters);
  RayCounters sum;
  for (const RayCounters& c : counters) sum += c;
  return sum;
}

}  // namespace boxwood::test
