#pragma once
#include <span>
#include <vector>

#include "layout/precise/precise_level.h"
#include "math/large_memory.h"
#include "structure/pipeline.h"

namespace boxwood {

/// Divides triangles into frames within frames, so that in each of them no box is so small that floats around the
/// frame's centre would lose it, and builds the tree of each. The outermost comes first. Numbers of frames and the
/// order of all depend on the triangles only. Parallel; O(n log n).
std::vector<PreciseFrameTree> build_frames(LargeVector<PreciseTriangle> triangles, const Pipeline& pipeline);

/// Largest coordinate in magnitude; 0 when there are no triangles.
double reach_of(std::span<const PreciseTriangle> triangles);

}  // namespace boxwood
