#include "advise/thin_scene.h"

#include <cmath>

#include "math/random.h"

namespace boxwood {
namespace {

Mesh thin_mesh(const Mesh& mesh, float share, Random random) {
  const float scale = 1 / std::sqrt(share);
  Mesh out;
  out.name = mesh.name;
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
    if (random.uniform() >= share || !is_usable(mesh, t)) continue;
    const auto& [a, b, c] = mesh.triangles[t];
    const Vec3 centre = (mesh.positions[a] + mesh.positions[b] + mesh.positions[c]) * (1.0f / 3);
    const auto first = static_cast<std::uint32_t>(out.positions.size());
    for (const std::uint32_t vertex : {a, b, c}) {
      out.positions.push_back(centre + (mesh.positions[vertex] - centre) * scale);
    }
    out.triangles.push_back({first, first + 1, first + 2});
  }
  return out;
}

}  // namespace

Scene thin_scene(const Scene& scene, std::uint64_t triangles, std::uint64_t seed) {
  const std::uint64_t all = scene.unique_triangles();
  if (triangles >= all) return scene;
  const float share = static_cast<float>(triangles) / static_cast<float>(all);
  Scene out;
  out.name = scene.name;
  out.instances = scene.instances;
  out.cameras = scene.cameras;
  for (std::size_t m = 0; m < scene.meshes.size(); ++m) {
    out.meshes.push_back(thin_mesh(scene.meshes[m], share, Random(seed, m)));
  }
  return out;
}

}  // namespace boxwood
