#pragma once
#include <cstdint>
#include <memory>
#include <vector>

#include "boxwood/custom.h"
#include "layout/layout.h"
#include "layout/leaves.h"
#include "layout/wide/wide_nodes.h"
#include "tree/tree.h"

namespace boxwood {

/// Wide nodes over boxes of primitives that only their owner can intersect. All that its kernels read.
struct CustomLevel {
  WideNodes nodes;
  std::vector<std::uint32_t> primitives;  ///< leaf by leaf
  Reach extent;
  std::shared_ptr<const CustomPrimitives> owner;
};

/// In nodes of 4, 8 or 16 children, the fewest that hold those of the tree. Throws UsageError on a wider tree.
std::shared_ptr<const Layout> encode_custom(Tree tree, std::shared_ptr<const CustomPrimitives> owner);

}  // namespace boxwood
