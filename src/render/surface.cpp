#include "render/surface.h"

#include <algorithm>
#include <cmath>

#include "render/textures.h"

namespace boxwood {
namespace {

struct DoubleVec3 {
  double x = 0, y = 0, z = 0;

  DoubleVec3() = default;
  DoubleVec3(double x_, double y_, double z_) : x(x_), y(y_), z(z_) {}
  explicit DoubleVec3(const Vec3& v) : x(v.x), y(v.y), z(v.z) {}
};

DoubleVec3 operator+(const DoubleVec3& a, const DoubleVec3& b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
DoubleVec3 operator-(const DoubleVec3& a, const DoubleVec3& b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
DoubleVec3 operator*(const DoubleVec3& a, double s) { return {a.x * s, a.y * s, a.z * s}; }
double dot(const DoubleVec3& a, const DoubleVec3& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
DoubleVec3 cross(const DoubleVec3& a, const DoubleVec3& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
Vec3 rounded(const DoubleVec3& v) {
  return {static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z)};
}
double largest_component(const DoubleVec3& v) { return std::max({std::fabs(v.x), std::fabs(v.y), std::fabs(v.z)}); }

DoubleVec3 to_world(const Transform& map, const Vec3& point) {
  const DoubleVec3 p(point);
  return DoubleVec3(map.x) * p.x + DoubleVec3(map.y) * p.y + DoubleVec3(map.z) * p.z + DoubleVec3(map.translation);
}

}  // namespace

SurfacePoint Surfaces::at(std::uint32_t instance_index, std::uint32_t primitive, float u, float v) const {
  const Instance& instance = scene_.instances[instance_index];
  const Mesh& mesh = scene_.meshes[instance.mesh];
  const Triangle& triangle = mesh.triangles[primitive];
  const Transform& map = instance.object_to_world;
  const DoubleVec3 a = to_world(map, mesh.positions[triangle[0]]);
  const DoubleVec3 b = to_world(map, mesh.positions[triangle[1]]);
  const DoubleVec3 c = to_world(map, mesh.positions[triangle[2]]);

  SurfacePoint point;
  point.position = rounded(a + (b - a) * static_cast<double>(u) + (c - a) * static_cast<double>(v));

  // The cross product of mapped edges is the determinant times the inverse transpose applied to the object's normal.
  const DoubleVec3 normal = cross(b - a, c - a);
  const double size = std::sqrt(dot(normal, normal));
  const double sign = map.determinant() < 0 ? -1 : 1;
  if (size > 0) point.normal = rounded(normal * (sign / size));

  // A triangle test errs by a few 2^-24 of the largest coordinate it meets.
  const double reach = std::max({largest_component(a), largest_component(b), largest_component(c)});
  point.clearance = static_cast<float>(reach * 0x1p-17);

  point.material = &material(instance_index, primitive);
  point.diffuse = diffuse(mesh, triangle, *point.material, u, v);
  return point;
}

Vec3 Surfaces::diffuse(const Mesh& mesh, const Triangle& triangle, const Material& material, float u, float v) const {
  if (material.texture >= scene_.textures.size() || mesh.texture_coordinates.empty()) return material.diffuse;
  const Texture& texture = scene_.textures[material.texture];
  const std::size_t pixels = std::size_t{texture.width} * texture.height;
  if (pixels == 0 || texture.pixels.size() != 3 * pixels) return material.diffuse;
  double at[2];
  for (std::size_t i = 0; i < 2; ++i) {
    const auto corner = [&](std::size_t vertex) { return double{mesh.texture_coordinates[triangle[vertex]][i]}; };
    at[i] =
        corner(0) + (corner(1) - corner(0)) * static_cast<double>(u) + (corner(2) - corner(0)) * static_cast<double>(v);
  }
  return material.diffuse * texture_color(texture, at[0], at[1]);
}

const Material& Surfaces::material(std::uint32_t instance, std::uint32_t primitive) const {
  const Mesh& mesh = scene_.meshes[scene_.instances[instance].mesh];
  if (mesh.materials.empty() || mesh.materials[primitive] >= scene_.materials.size()) return fallback_;
  return scene_.materials[mesh.materials[primitive]];
}

}  // namespace boxwood
