#pragma once
#include <array>
#include <cstdint>
#include <vector>

#include "boxwood/scene.h"

namespace boxwood {

/// A corner of an OBJ face: indices from 0 of position, texture coordinate and normal.
struct ObjCorner {
  static constexpr std::uint32_t none = 0xffffffffu;
  std::uint32_t position = none, texture = none, normal = none;
};

/// Turns corners into vertices of a mesh, one per distinct combination, in order of first use. O(1) each: combinations
/// that share a position are chained.
class ObjVertices {
 public:
  std::vector<Vec3> positions, normals;  ///< as the file lists them
  std::vector<std::array<float, 2>> texture_coordinates;

  std::uint32_t vertex(const ObjCorner& corner);
  /// Moves the vertices made so far into a mesh; attributes that no corner named stay empty, missing ones are zero.
  void move_into(Mesh& mesh);

 private:
  struct Vertex {
    ObjCorner corner;
    std::uint32_t next;  // with the same position
  };
  std::vector<Vertex> vertices_;
  std::vector<std::uint32_t> first_;  // per position
  bool any_texture_ = false, any_normal_ = false;
};

}  // namespace boxwood
