#pragma once
#include <cstdint>
#include <functional>

#include "build/build_input.h"
#include "moving/part_accounts.h"
#include "tree/parts.h"
#include "tree/tree.h"

namespace boxwood {

/// Builds some parts of a tree anew, with the nodes above the parts when they are due, keeps all else, and what
/// was due where the new tree would be no better. `build` is
/// given the references of a part, in order, or one reference per part, without geometry; it must be thread safe. No
/// node of the result has more children than `arity` or the trees that `build` makes. Parallel.
Tree rebuild_parts(const Tree& tree, const TreeParts& parts, const DueParts& due, std::uint32_t arity,
                   const std::function<Tree(LargeVector<Reference>, bool of_triangles)>& build,
                   const std::function<Box(std::uint32_t primitive)>& box_of);

}  // namespace boxwood
