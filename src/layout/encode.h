#pragma once
#include <cstddef>
#include <cstdint>
#include <string_view>
#include <vector>

#include "tree/tree.h"

namespace boxwood {

/// Room for the open ends of one walk. A walk needs, along a path from the root to a leaf, one entry per sibling; even
/// the 256-wide trees of real scenes stay far below.
inline constexpr std::uint32_t stack_entries = 8192;

/// Refuses what the kernels of `layout` could not walk: nodes of more than `arity` children (UsageError), and paths
/// that need more than stack_entries (Error). O(nodes).
void check_walkable(const Tree& tree, std::uint32_t arity, std::string_view layout);

/// For every node of the tree its place in depth-first order: children follow their parent, each with its whole subtree
/// before the next. With `inner_only`, leaves take no place. Two passes in memory order; no recursion.
std::vector<std::uint32_t> depth_first_places(const Tree& tree, bool inner_only);

}  // namespace boxwood
