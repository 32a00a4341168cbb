#pragma once
#include <cstddef>
#include <cstdint>
#include <vector>

#include "boxwood/box.h"
#include "boxwood/layout_fact.h"
#include "layout/octree/octree_topology.h"
#include "layout/trace_options.h"
#include "tree/octree_cells.h"

namespace boxwood {

/// References of one leaf.
struct OctreeLeaf {
  std::uint32_t first = 0, count = 0;
};

/// What every layout of an octree has beside its topology.
struct OctreeHead {
  OctreeGrid grid;
  std::vector<std::uint32_t> references;  ///< leaf by leaf; places in the leaf content, which holds each primitive once
  std::uint64_t primitives = 0;           ///< that the references refer to
  std::uint64_t inner_nodes = 0;
  bool filled = false;  ///< there is something in it
  bool mailbox = true;
  TraceOptions trace;

  std::uint64_t nodes() const { return filled ? 8 * inner_nodes + 1 : 0; }
  std::size_t reference_bytes() const { return references.size() * sizeof(std::uint32_t); }
  void add_facts(std::vector<LayoutFact>& facts) const {
    facts.push_back({"octree_nodes", static_cast<double>(nodes())});
    facts.push_back({"octree_leaves", static_cast<double>(filled ? 7 * inner_nodes + 1 : 0)});
    facts.push_back({"leaf_references", static_cast<double>(references.size())});
    facts.push_back(
        {"primitive_multiplication", static_cast<double>(references.size()), static_cast<double>(primitives)});
  }
};

}  // namespace boxwood
