#pragma once
#include <cstdint>
#include <vector>

#include "boxwood/box.h"
#include "tree/tree.h"

namespace boxwood::viewer {

/// A node drawn over the picture.
struct LevelBox {
  Box box;
  std::uint32_t node = 0;
  bool leaf = false;
  float heat = 0;  ///< 0…1: cost of its subtree, in parts of the highest shown
};

/// The nodes `level` edges below the root, and leaves that end above, at most `most`, the largest first. Their cost is
/// the surface area cost of their subtree: what a random ray through the root is expected to spend below. O(nodes).
std::vector<LevelBox> boxes_of_level(const Tree& tree, std::uint32_t level, std::size_t most);

/// Edges from the root to the deepest leaf.
std::uint32_t height_of(const Tree& tree);

}  // namespace boxwood::viewer
