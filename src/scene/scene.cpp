#include "boxwood/scene.h"

#include <fmt/format.h>
#include <tbb/blocked_range.h>
#include <tbb/parallel_reduce.h>

#include <cmath>

#include "scene/placement.h"

namespace boxwood {
namespace {

bool within_limits(const Vec3& p) {
  return std::fabs(p.x) <= largest_coordinate && std::fabs(p.y) <= largest_coordinate &&
         std::fabs(p.z) <= largest_coordinate;
}

Box world_bounds(const Mesh& mesh, const Transform& object_to_world) {
  using Range = tbb::blocked_range<std::uint32_t>;
  return tbb::parallel_reduce(
      Range(0, static_cast<std::uint32_t>(mesh.triangles.size()), 1 << 14), Box{},
      [&](const Range& range, Box box) {
        for (std::uint32_t i = range.begin(); i < range.end(); ++i) {
          if (!is_usable(mesh, i)) continue;
          for (const std::uint32_t vertex : mesh.triangles[i]) box.grow(object_to_world.point(mesh.positions[vertex]));
        }
        return box;
      },
      [](Box a, const Box& b) { return unite(a, b); });
}

}  // namespace

bool is_usable(const Mesh& mesh, std::uint32_t triangle) {
  const auto& [ia, ib, ic] = mesh.triangles[triangle];
  const Vec3 &a = mesh.positions[ia], &b = mesh.positions[ib], &c = mesh.positions[ic];
  if (!(within_limits(a) && within_limits(b) && within_limits(c))) return false;
  // In double, products of two differences neither overflow nor vanish.
  const auto difference = [](float p, float q) { return static_cast<double>(p) - static_cast<double>(q); };
  const double ux = difference(b.x, a.x), uy = difference(b.y, a.y), uz = difference(b.z, a.z);
  const double vx = difference(c.x, a.x), vy = difference(c.y, a.y), vz = difference(c.z, a.z);
  return uy * vz - uz * vy != 0 || uz * vx - ux * vz != 0 || ux * vy - uy * vx != 0;
}

void Scene::add_mesh(std::vector<Vec3> positions, std::vector<Triangle> triangles) {
  for (std::size_t i = 0; i < triangles.size(); ++i) {
    for (const std::uint32_t vertex : triangles[i]) {
      if (vertex >= positions.size()) {
        throw Error(
            fmt::format("triangle {} refers to position {} of {}; indices count from 0", i, vertex, positions.size()));
      }
    }
  }
  const auto mesh = static_cast<std::uint32_t>(meshes.size());
  Mesh& added = meshes.emplace_back();
  added.positions = std::move(positions);
  added.triangles = std::move(triangles);
  instances.push_back({mesh, {}});
}

std::uint64_t Scene::unique_triangles() const {
  std::uint64_t count = 0;
  for (const Mesh& mesh : meshes) count += mesh.triangles.size();
  return count;
}

std::uint64_t Scene::placed_triangles() const {
  std::uint64_t count = 0;
  for (const Instance& instance : instances) count += meshes[instance.mesh].triangles.size();
  return count;
}

Box Scene::bounds() const {
  Box box;
  for (const Instance& instance : instances) box.grow(world_bounds(meshes[instance.mesh], instance.object_to_world));
  return box;
}

bool Scene::single_level() const {
  return meshes.size() == 1 && instances.size() == 1 && instances[0].object_to_world == Transform{} &&
         instances[0].mask == every_bit;
}

Scene flatten(const Scene& scene) {
  Scene flat{.name = scene.name,
             .meshes = {},
             .instances = {{0, {}}},
             .materials = scene.materials,
             .textures = scene.textures,
             .cameras = scene.cameras,
             .lights = scene.lights,
             .notes = scene.notes};
  flat.meshes.push_back(merge_placed(scene.meshes, scene.instances, flat.materials));
  return flat;
}

}  // namespace boxwood
