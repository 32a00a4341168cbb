#pragma once
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "boxwood/box.h"
#include "boxwood/ray.h"
#include "boxwood/transform.h"
#include "layout/layout.h"
#include "recipe/stage.h"
#include "trace/leaf_triangle.h"

namespace boxwood {

/// Leaf content of a bottom level: triangles in leaf order.
struct TriangleLeaves {
  std::vector<LeafTriangle> triangles;

  std::size_t bytes() const { return triangles.size() * sizeof(LeafTriangle); }
};

/// One instance in a leaf. 64 bytes, one cache line: the map into its space, its structure, the number of the first
/// instance in there (its own, where that is triangles), its mask.
struct InstanceLeaf {
  Transform world_to_object;
  const Layout* bottom = nullptr;
  std::uint32_t instance = 0;
  std::uint32_t mask = every_bit;
};
static_assert(sizeof(InstanceLeaf) == 64);

/// Leaf content of a level above: instances in leaf order.
struct InstanceLeaves {
  std::vector<InstanceLeaf> instances;
  std::vector<std::shared_ptr<const Layout>> bottoms;  ///< keeps what `instances` point to

  std::size_t bytes() const { return instances.size() * sizeof(InstanceLeaf); }
};

/// Copies the triangles that `references` name. Parallel; O(references).
TriangleLeaves triangle_leaves(std::span<const std::uint32_t> references, const Mesh& mesh);
/// Their positions as they are in `mesh` now. Parallel; O(triangles).
void move_triangles(TriangleLeaves& leaves, const Mesh& mesh);
/// Throws Error naming an instance whose transform has no inverse. O(references).
InstanceLeaves instance_leaves(std::span<const std::uint32_t> references, const Contents& contents);

/// The error bound that rays need below a root with box `bounds`. For a level above, what its leaves
/// round is added; `references` are those they were made from.
Reach extent_of(const TriangleLeaves& leaves, std::span<const std::uint32_t> references, const Box& bounds,
                const Contents& contents);
Reach extent_of(const InstanceLeaves& leaves, std::span<const std::uint32_t> references, const Box& bounds,
                const Contents& contents);

}  // namespace boxwood
