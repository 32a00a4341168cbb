#pragma once
// Octrees over the triangles of a scene's first mesh, and what the tests ask of them.
#include <string>
#include <vector>

#include "build/octree/stages.h"
#include "layout/octree/stages.h"
#include "options/call.h"
#include "structure/mesh_geometry.h"
#include "support/scenes.h"
#include "support/trees.h"
#include "tree/validate.h"

namespace boxwood::test {

inline StageCall octree_call(const std::string& text) {
  static const Stage stage = octree_builder_stage();
  StageCall call{&stage, stage.defaults};
  for (const std::string_view argument : parse_call_text(text).arguments) {
    set_option(stage.name, stage.options, call.options, argument);
  }
  return call;
}

/// `text`: a call of the builder, such as "octree(primitives=2)".
inline Tree octree_of(const Mesh& mesh, const std::string& text) {
  const MeshGeometry geometry(mesh);
  const StageCall call = octree_call(text);
  return call.stage->build(call.options, {geometry.references(), &geometry});
}

inline const std::vector<std::string>& octree_calls() {
  static const std::vector<std::string> all = {
      "octree",
      "octree(primitives=2, multiplication=8, depth=4, budget=10000)",
      "octree(primitives=2, multiplication=3, depth=5, budget=10000)",
      "octree(primitives=4, exact=off)",
      "octree(decider=depth, depth=3, primitives=3, budget=10000)",
      "octree(decider=cluster, depth=4, primitives=4, budget=10000)",
      "octree(decider=sah, primitives=2)",
      "octree(decider=sah, primitives=2, traversal_cost=0.5, depth=5, budget=10000)"};
  return all;
}

}  // namespace boxwood::test
