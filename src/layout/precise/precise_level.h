#pragma once
#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

#include "boxwood/precise.h"
#include "layout/layout.h"
#include "layout/wide/wide_nodes.h"
#include "math/large_memory.h"
#include "recipe/stage.h"
#include "trace/precise_triangle.h"
#include "tree/tree.h"

namespace boxwood {

/// Frames within frames; no deeper, because each is at most 2^-10 of the one around it and they end at 2^-28.
inline constexpr std::uint32_t most_frames_deep = 4;

/// Wide nodes of single-precision boxes in a space of their own: x there is (x - center) * scale. A box that floats
/// hold around a centre of its own is off by 2^-24 of the frame, not of the world.
struct PreciseFrame {
  DoubleVec3 center;
  double scale = 1;  ///< a power of two, which makes `reach` something like 1
  float reach = 0;   ///< largest coordinate of a box, in the frame's space
  WideNodes nodes;
  std::uint32_t first_entry = 0;  ///< of its leaves in PreciseLevel::entries
};

/// Frames within frames over triangles in double precision. All that kernels read.
struct PreciseLevel {
  std::uint32_t k = 4;                   ///< children of a node in every frame: 4, 8 or 16
  double reach = 0;                      ///< largest coordinate of a vertex
  std::vector<PreciseFrame> frames;      ///< 0: the outermost; empty when there is no triangle
  std::vector<PreciseTriangle> entries;  ///< leaf by leaf, frame by frame

  std::size_t bytes() const;
};

/// A tree in the space of a frame, and what its references stand for.
struct PreciseFrameTree {
  DoubleVec3 center;
  double scale = 1;
  Tree tree;
  LargeVector<PreciseTriangle> content;
};

/// Lays out trees in nodes of 4, 8 or 16 children, the fewest that hold those of all. Throws UsageError on wider trees.
PreciseLevel encode_precise_level(const std::vector<PreciseFrameTree>& trees, double reach);

/// A layout in double precision over one mesh in single: rays are widened and hits are rounded. Closest and any hits
/// only. Throws UsageError on `contents` with instances.
std::shared_ptr<const Layout> encode_precise(Tree tree, const Contents& contents);

}  // namespace boxwood
