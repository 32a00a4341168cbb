#include "scene/importers/obj_vertices.h"

namespace boxwood {

std::uint32_t ObjVertices::vertex(const ObjCorner& corner) {
  if (first_.size() < positions.size()) first_.resize(positions.size(), ObjCorner::none);
  std::uint32_t* link = &first_[corner.position];
  while (*link != ObjCorner::none) {
    Vertex& known = vertices_[*link];
    if (known.corner.texture == corner.texture && known.corner.normal == corner.normal) return *link;
    link = &known.next;
  }
  const auto number = static_cast<std::uint32_t>(vertices_.size());
  *link = number;
  vertices_.push_back({corner, ObjCorner::none});
  any_texture_ |= corner.texture != ObjCorner::none;
  any_normal_ |= corner.normal != ObjCorner::none;
  return number;
}

void ObjVertices::move_into(Mesh& mesh) {
  mesh.positions.reserve(vertices_.size());
  for (const Vertex& v : vertices_) mesh.positions.push_back(positions[v.corner.position]);
  if (any_texture_) {
    mesh.texture_coordinates.resize(vertices_.size());
    for (std::size_t i = 0; i < vertices_.size(); ++i) {
      const std::uint32_t from = vertices_[i].corner.texture;
      if (from != ObjCorner::none) mesh.texture_coordinates[i] = texture_coordinates[from];
    }
  }
  if (any_normal_) {
    mesh.normals.resize(vertices_.size());
    for (std::size_t i = 0; i < vertices_.size(); ++i) {
      const std::uint32_t from = vertices_[i].corner.normal;
      if (from != ObjCorner::none) mesh.normals[i] = normals[from];
    }
  }
}

}  // namespace boxwood
