#include "measure/fingerprint.h"

#include <bit>

namespace boxwood {
namespace {

void add(Fingerprint& print, const Vec3& vector) {
  for (const float x : {vector.x, vector.y, vector.z}) print.add(std::bit_cast<std::uint32_t>(x));
}

}  // namespace

std::uint64_t fingerprint(const Scene& scene) {
  Fingerprint print;
  for (const Mesh& mesh : scene.meshes) {
    print.add(mesh.positions.size());
    for (const Vec3& position : mesh.positions) add(print, position);
    print.add(mesh.triangles.size());
    for (const Triangle& triangle : mesh.triangles) {
      for (const std::uint32_t corner : triangle) print.add(corner);
    }
  }
  print.add(scene.instances.size());
  for (const Instance& instance : scene.instances) {
    print.add(instance.mesh);
    const Transform& map = instance.object_to_world;
    for (const Vec3& column : {map.x, map.y, map.z, map.translation}) add(print, column);
  }
  return print.value();
}

}  // namespace boxwood
