// What a layout tells of itself: bytes, chunks, references.
#include <array>

#include "measure/probes/probes.h"

namespace boxwood {
namespace {

const std::vector<Metric>& metrics() {
  static const std::vector<Metric> all = {
      {"topology_bytes", "bytes", "what a walk reads at every step: nodes, chunks, keys"},
      {"leaf_bytes", "bytes", "all other: leaves' sizes, offsets, references, triangles"},
      {"octree_nodes", "nodes", "of an octree, with empty leaves"},
      {"octree_leaves", "leaves", "of an octree, with empty ones"},
      {"leaf_references", "", "references at the leaves of an octree"},
      {"primitive_multiplication", "", "references at the leaves for each primitive"},
      {"chunks", "", "chunks of bits"},
      {"chunk_fill", "", "nodes in chunks over nodes they have room for"},
      {"absent_children", "", "places of wide quantized nodes that are filled up"},
      {"lane_fill", "", "children of SIMD nodes over children that they have room for"},
      {"leaf_fill", "", "bytes of the triangles of SIMD leaves over bytes of the leaves"}};
  return all;
}

std::vector<Value> measure_layout(const ProbeInput& input) {
  std::vector<Value> values;
  for (const LayoutFact& fact : input.structure.report().facts) values.push_back({fact.name, fact.figure()});
  return values;
}

}  // namespace

Probe layout_probe() {
  return {"layout", ProbeScope::structure, false, "what the layout tells of itself", metrics(), measure_layout};
}

}  // namespace boxwood
