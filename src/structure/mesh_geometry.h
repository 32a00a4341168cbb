#pragma once
#include <span>
#include <vector>

#include "boxwood/scene.h"
#include "build/build_input.h"

namespace boxwood {

/// What builders may ask about the triangles of a mesh. Refers to the mesh.
class MeshGeometry final : public Geometry {
 public:
  explicit MeshGeometry(const Mesh& mesh) : mesh_(mesh) {}

  Vec3 centroid(std::uint32_t primitive) const override;
  Box clip(std::uint32_t primitive, const Box& region) const override;
  bool corners(std::uint32_t primitive, Vec3 (&out)[3]) const override;
  /// One reference per usable triangle, in order. Parallel; O(n).
  LargeVector<Reference> references() const;

 private:
  const Mesh& mesh_;
};

/// Bounds of the usable triangles. O(n).
Box usable_bounds(const Mesh& mesh);

/// World boxes of all instances; empty where a mesh has no usable triangle. O(triangles).
std::vector<Box> instance_boxes(const Scene& scene);

/// One reference per instance that has a box, by number.
LargeVector<Reference> instance_references(std::span<const Box> boxes);

}  // namespace boxwood
