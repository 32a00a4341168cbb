#include "scene/importers/pbrt/assembly.h"

#include <fmt/format.h>

#include <algorithm>

#include "scene/placement.h"

namespace boxwood::pbrt {
namespace {

constexpr std::uint64_t most_placements = std::uint64_t{1} << 24;
constexpr std::uint32_t deepest_object = 64;

/// Whether the triangle runs clockwise seen from where its normals point.
bool runs_against(const Mesh& mesh, const Triangle& t) {
  const Vec3 &a = mesh.positions[t[0]], &b = mesh.positions[t[1]], &c = mesh.positions[t[2]];
  const Vec3 normals = mesh.normals[t[0]] + mesh.normals[t[1]] + mesh.normals[t[2]];
  return dot(cross(b - a, c - a), normals) < 0;
}

void append_vertices(Mesh& out, const Mesh& shape, const Assembly::Placing& placing) {
  const std::size_t first = out.positions.size();
  for (const Vec3& position : shape.positions) out.positions.push_back(placing.to_world.point(position));
  if (!shape.normals.empty()) {
    out.normals.resize(first);
    for (const Vec3& normal : shape.normals) {
      out.normals.push_back(map_normal(placing.to_world, normal) * (placing.reverse ? -1.0f : 1.0f));
    }
  } else if (!out.normals.empty()) {
    out.normals.resize(out.positions.size());
  }
}

}  // namespace

void Assembly::add(const Mesh& shape, const Placing& placing, const std::string& place) {
  Mesh& out = objects_[defining_ ? objects_.size() - 1 : 0].mesh;
  const std::size_t first = out.positions.size();
  if (std::max(first + shape.positions.size(), out.triangles.size() + shape.triangles.size()) >= 0xffffffffu) {
    throw Error(
        fmt::format("{}: the scene has more than 2^32 - 2 triangles or vertices; make parts of it objects", place));
  }
  append_vertices(out, shape, placing);
  // A map that mirrors turns triangles round; their front stays where it was. Normals, where there are some, say best.
  const bool turn = placing.reverse != (placing.to_world.determinant() < 0);
  for (const Triangle& triangle : shape.triangles) {
    Triangle moved;
    for (std::size_t i = 0; i < 3; ++i) moved[i] = static_cast<std::uint32_t>(first + triangle[i]);
    if (shape.normals.empty() ? turn : runs_against(out, moved)) std::swap(moved[1], moved[2]);
    out.triangles.push_back(moved);
  }
  out.materials.resize(out.triangles.size(), placing.material);
}

void Assembly::begin_object(std::string name) {
  defining_ = true;
  defined_name_ = std::move(name);
  objects_.emplace_back();
}

void Assembly::end_object() {
  defining_ = false;
  ++objects_.back().placements;
  names_[defined_name_] = static_cast<std::uint32_t>(objects_.size() - 1);
}

bool Assembly::place_object(const std::string& name, const Transform& to_world, const std::string& place) {
  const auto found = names_.find(name);
  if (found == names_.end()) return false;
  Object& parent = objects_[defining_ ? objects_.size() - 1 : 0];
  const Object& placed = objects_[found->second];
  if (defining_) parent.depth = std::max(parent.depth, placed.depth + 1);
  if (parent.depth > deepest_object) {
    throw Error(fmt::format("{}: objects are nested more than {} deep; flatten them", place, deepest_object));
  }
  parent.placements += placed.placements;
  if (parent.placements > most_placements) {
    throw Error(fmt::format("{}: this makes more than 2^24 placements of objects; use fewer", place));
  }
  parent.parts.push_back({found->second, to_world});
  return true;
}

std::uint16_t Assembly::material(const Material& m, const std::string& place) {
  MaterialKey key;
  for (const Vec3& color : {m.diffuse, m.emission, m.specular, m.reflection, m.transmission}) {
    key.insert(key.end(), {color.x, color.y, color.z});
  }
  key.insert(key.end(), {m.shininess, m.refraction_index, m.emits_behind ? 1.0f : 0.0f});
  // NaN would break the order of keys.
  for (float& value : key) value = value == value ? value : 0;
  const auto [known, is_new] = material_numbers_.try_emplace(key, static_cast<std::uint16_t>(materials_.size()));
  if (!is_new) return known->second;
  if (materials_.size() == 0xffff) {
    throw Error(fmt::format("{}: the scene has more than 65,535 different materials; merge some", place));
  }
  materials_.push_back(m);
  return known->second;
}

void Assembly::expand(std::uint32_t number, const Transform& to_world, Scene& scene) const {
  const Object& object = objects_[number];
  if (!scene.meshes[number].triangles.empty()) scene.instances.push_back({number, to_world});
  for (const Part& part : object.parts) expand(part.object, to_world * part.to_parent, scene);
}

Scene Assembly::finish() {
  Scene scene;
  for (Object& object : objects_) scene.meshes.push_back(std::move(object.mesh));
  expand(0, {}, scene);
  scene.materials = std::move(materials_);
  // What is placed once will be merged, which keeps the order of corners, so a mirrored one is turned round before.
  std::vector<std::uint32_t> placements(scene.meshes.size(), 0);
  for (const Instance& instance : scene.instances) ++placements[instance.mesh];
  for (const Instance& instance : scene.instances) {
    if (placements[instance.mesh] > 1 || !(instance.object_to_world.determinant() < 0)) continue;
    for (Triangle& triangle : scene.meshes[instance.mesh].triangles) std::swap(triangle[1], triangle[2]);
  }
  return scene;
}

}  // namespace boxwood::pbrt
