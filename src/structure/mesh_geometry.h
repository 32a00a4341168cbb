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
  std::vector<Reference> references() const;

 private:
  const Mesh& mesh_;
};

/// Bounds of the usable triangles. O(n).
Box usable_bounds(const Mesh& mesh);

/// One reference per instance whose mesh has a usable triangle, with the world box of that mesh's box.
std::vector<Reference> instance_references(const Scene& scene, std::span<const Box> mesh_boxes);

}  // namespace boxwood
