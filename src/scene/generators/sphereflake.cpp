// Sphere flake: every sphere carries nine of a third its size. After "balls" of Haines 1987, "A Proposal for Standard
// Graphics Environments".
#include <array>

#include "math/sampling.h"
#include "scene/generators/generator.h"
#include "scene/generators/shapes.h"

namespace boxwood {
namespace {

struct Flake {
  std::uint32_t depth = 3;
  std::uint32_t detail = 4;
};

/// Six children around the equator and three above it, for a sphere that grows along +z.
std::array<Vec3, 9> child_directions() {
  std::array<Vec3, 9> directions;
  for (std::size_t i = 0; i < 9; ++i) {
    const bool equator = i < 6;
    const SineCosine around =
        sine_cosine_of_turns(equator ? static_cast<double>(i) / 6 : (static_cast<double>(i) + 0.25) / 3);
    const SineCosine up = sine_cosine_of_turns(equator ? 0 : 1.0 / 7);
    directions[i] = {static_cast<float>(up.cosine * around.cosine), static_cast<float>(up.cosine * around.sine),
                     static_cast<float>(up.sine)};
  }
  return directions;
}

void append_flake(Mesh& to, const Mesh& sphere, const Vec3& center, float radius, const Vec3& growth,
                  std::uint32_t depth) {
  append(to, sphere, radius, center);
  if (depth == 0) return;
  static const std::array<Vec3, 9> directions = child_directions();
  const Basis basis(growth);
  const float child = radius / 3;
  for (const Vec3& local : directions) {
    const Vec3 direction = normalize(basis.around_normal(local));
    append_flake(to, sphere, center + direction * (radius + child), child, direction, depth - 1);
  }
}

Mesh flake_mesh(const Flake& o) {
  std::uint64_t spheres = 1;
  for (std::uint32_t i = 0; i < o.depth; ++i) spheres = spheres * 9 + 1;
  check_size(spheres * 12 * o.detail * o.detail);
  Mesh mesh;
  append_flake(mesh, sphere_mesh(o.detail), {0, 0, 0}, 1, {0, 1, 0}, o.depth);
  return mesh;
}

}  // namespace

Generator sphereflake_generator() {
  return mesh_generator(
      "sphereflake", "spheres on spheres on spheres",
      OptionsOf<Flake>()
          .integer("depth", &Flake::depth, 0, 7, "levels below the first sphere; nine times more each")
          .positional()
          .integer("detail", &Flake::detail, 1, 256, "12 * detail^2 triangles per sphere"),
      flake_mesh);
}

}  // namespace boxwood
