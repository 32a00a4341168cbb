#pragma once
#include <cstdint>
#include <vector>

#include "boxwood/box.h"
#include "boxwood/scene.h"
#include "tree/tree.h"

namespace boxwood {

/// Three axes; a point p lies at (axis[i] . p).
struct Frame {
  float axis[3][3];
};

/// Which inner nodes of a tree over triangles have their children's boxes turned, and how.
class Frames {
 public:
  /// Tries the principal axes of the area below every node. Parallel.
  Frames(const Tree& tree, const Mesh& mesh, float area);

  bool turned(std::uint32_t node) const { return places_[node] != world; }
  const Frame& frame(std::uint32_t node) const { return frames_[places_[node]]; }
  std::uint32_t count() const { return static_cast<std::uint32_t>(frames_.size()); }

 private:
  static constexpr std::uint32_t world = ~0u;
  std::vector<std::uint32_t> places_;  ///< by node
  std::vector<Frame> frames_;
};

/// The box, in a frame, around all triangles below a node. It holds them exactly: computed in double and rounded out.
Box turned_box(const Tree& tree, std::uint32_t node, const Mesh& mesh, const Frame& frame);

}  // namespace boxwood
