#pragma once
#include <vector>

#include "build/build_input.h"

namespace boxwood {

/// Cuts long triangles before a tree is built, so that any builder gets most of what spatial splits give. Of `budget`
/// times as many references as there are, no more are added, and fewer where few triangles have boxes much emptier than
/// the others'. Pieces of a triangle follow one another. Karras and Aila 2013, "Fast Parallel Construction of
/// High-Quality Bounding Volume Hierarchies", section 4.3. Parallel, O(n); the same for any number of threads.
LargeVector<Reference> presplit(LargeVector<Reference> references, const Geometry& geometry, float budget);

}  // namespace boxwood
