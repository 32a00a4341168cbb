// Unconnected random triangles and tetrahedra; the sets of spec 002, protocols P1 to P3.
#include "math/random.h"
#include "math/sampling.h"
#include "scene/generators/generator.h"
#include "scene/generators/shapes.h"

namespace boxwood {
namespace {

struct Soup {
  std::uint32_t triangles = 10'000;
  float size = 0.05f;
  std::uint32_t seed = 1;
};

/// The first n triangles are the same for every count, so that prefixes of one set can be compared.
Mesh random_mesh(const Soup& o) {
  Mesh mesh;
  for (std::uint32_t i = 0; i < o.triangles; ++i) {
    Random random(o.seed, i);
    const Vec3 corner = uniform_point(random, 0, 1 - o.size);
    const Vec3 a = corner + uniform_point(random, 0, o.size), b = corner + uniform_point(random, 0, o.size);
    append_triangle(mesh, a, b, corner + uniform_point(random, 0, o.size));
  }
  return mesh;
}

/// A grid with spacing 1 of equal solids, each turned at random and moved a little.
template <std::uint32_t default_count>
struct Grid {
  std::uint32_t x = default_count, y = default_count, z = default_count;
  float edge = 0.5f;
  float shift = 0.25f;
  std::uint32_t seed = 1;
};

template <class Options, class Append>
Mesh displaced_mesh(const Options& o, std::uint64_t triangles_each, const Append& append_solid) {
  check_size(std::uint64_t{o.x} * o.y * o.z * triangles_each);
  Mesh mesh;
  std::uint64_t cell = 0;
  for (std::uint32_t z = 0; z < o.z; ++z) {
    for (std::uint32_t y = 0; y < o.y; ++y) {
      for (std::uint32_t x = 0; x < o.x; ++x) {
        Random random(o.seed, cell++);
        const float u = random.uniform(), v = random.uniform(), w = random.uniform();
        Transform place = uniform_rotation(u, v, w);
        place.translation = Vec3{static_cast<float>(x), static_cast<float>(y), static_cast<float>(z)} +
                            uniform_point(random, -o.shift, o.shift);
        append_solid(mesh, place);
      }
    }
  }
  return mesh;
}

template <class Options>
OptionsOf<Options> grid_options() {
  OptionsOf<Options> options;
  options.integer("x", &Options::x, 1, 2048, "cells along x")
      .integer("y", &Options::y, 1, 2048, "cells along y")
      .integer("z", &Options::z, 1, 2048, "cells along z")
      .real("edge", &Options::edge, 0, 10, "length of every edge; the spacing is 1")
      .real("shift", &Options::shift, 0, 10, "largest move along each axis")
      .integer("seed", &Options::seed, 0, 0xffffffffu, "another one, another scene");
  return options;
}

}  // namespace

Generator random_generator() {
  return mesh_generator("random", "random triangles in the unit cube",
                        OptionsOf<Soup>()
                            .integer("triangles", &Soup::triangles, 0, 100'000'000, "how many")
                            .positional()
                            .real("size", &Soup::size, 0, 1, "side of the cube that holds a triangle; 1: the unit cube")
                            .integer("seed", &Soup::seed, 0, 0xffffffffu, "another one, another scene"),
                        random_mesh);
}

Generator displaced_generator() {
  using Options = Grid<24>;
  return mesh_generator<Options>("displaced", "a grid of equal triangles, each randomly turned and moved",
                                 grid_options<Options>(), [](const Options& o) {
                                   const float radius = o.edge / std::sqrt(3.0f);  // of the circle through the vertices
                                   return displaced_mesh(o, 1, [&](Mesh& mesh, const Transform& place) {
                                     append_triangle(mesh, place.point({radius, 0, 0}),
                                                     place.point({radius * -0.5f, o.edge * 0.5f, 0}),
                                                     place.point({radius * -0.5f, o.edge * -0.5f, 0}));
                                   });
                                 });
}

Generator tetrahedra_generator() {
  using Options = Grid<14>;
  return mesh_generator<Options>(
      "tetrahedra", "a grid of equal regular tetrahedra, each randomly turned and moved", grid_options<Options>(),
      [](const Options& o) {
        const float s = o.edge / std::sqrt(8.0f);  // half the side of the cube whose corners are used
        return displaced_mesh(o, 4, [&](Mesh& mesh, const Transform& place) {
          const auto first = static_cast<std::uint32_t>(mesh.positions.size());
          for (const Vec3& corner : {Vec3{s, s, s}, Vec3{s, -s, -s}, Vec3{-s, s, -s}, Vec3{-s, -s, s}}) {
            mesh.positions.push_back(place.point(corner));
          }
          constexpr std::uint32_t sides[4][3] = {{0, 1, 2}, {0, 3, 1}, {0, 2, 3}, {1, 3, 2}};
          for (const auto& [a, b, c] : sides) mesh.triangles.push_back({first + a, first + b, first + c});
        });
      });
}

}  // namespace boxwood
