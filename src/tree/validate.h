#pragma once
#include <cstdint>
#include <span>
#include <string>

#include "boxwood/box.h"
#include "tree/tree.h"

namespace boxwood {

/// Checks every invariant of Tree. `bounds[i]` is the box of primitive i; a primitive whose box is empty must not be
/// referenced, every other one must be (exactly once unless clipped_leaves). Returns an empty string, or one sentence
/// that names the first broken invariant and the node or primitive where it is broken. `max_arity` 0: any. O(nodes +
/// references).
std::string validate(const Tree& tree, std::span<const Box> bounds, std::uint32_t max_arity = 0);

}  // namespace boxwood
