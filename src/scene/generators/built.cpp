// Things people build: a city of boxes, a stadium with a small dense object in it, a rack of instances.
#include <algorithm>
#include <cmath>

#include "math/random.h"
#include "math/sampling.h"
#include "scene/generators/generator.h"
#include "scene/generators/shapes.h"

namespace boxwood {
namespace {

struct City {
  std::uint32_t blocks = 24;
  std::uint32_t seed = 1;
};

/// Blocks of four towers, each of up to three closed boxes that stand on each other, on a square of ground.
Mesh city_mesh(const City& o) {
  check_size(std::uint64_t{o.blocks} * o.blocks * 4 * 3 * 12);
  const float side = static_cast<float>(o.blocks);
  Mesh mesh;
  mesh.positions = {{0, 0, 0}, {0, 0, side}, {side, 0, side}, {side, 0, 0}};
  mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
  for (std::uint32_t tower = 0; tower < o.blocks * o.blocks * 4; ++tower) {
    Random random(o.seed, tower);
    const std::uint32_t block = tower / 4, row = block / o.blocks;
    const float x = static_cast<float>(block % o.blocks) + 0.1f + static_cast<float>(tower % 2) * 0.4f;
    const float z = static_cast<float>(row) + 0.1f + static_cast<float>(tower / 2 % 2) * 0.4f;
    const std::uint32_t stories = 1 + random.below(3);
    float floor = 0, inset = random.uniform(0, 0.05f);
    for (std::uint32_t story = 0; story < stories; ++story) {
      const float rise = random.uniform(0.1f, 0.8f);
      append_box(mesh, {{x + inset, floor, z + inset}, {x + 0.4f - inset, floor + rise, z + 0.4f - inset}});
      floor += rise;
      inset += random.uniform(0.01f, 0.06f);
    }
  }
  return mesh;
}

struct Stadium {
  std::uint32_t detail = 80;
  float scale = 0.2f;
};

/// A hall of 100 x 30 x 140 with eight rows of seats on each long side, and the knot in its middle.
Scene stadium_scene(const Stadium& o) {
  constexpr float half_width = 50, height = 30, half_length = 70;
  constexpr int rows = 8;
  Mesh mesh;
  append_box(mesh, {{-half_width, 0, -half_length}, {half_width, height, half_length}});
  for (const float side : {-1.0f, 1.0f}) {
    for (int row = 0; row < rows; ++row) {
      const float near = 25 + 2.5f * static_cast<float>(row), top = 1 + 1.5f * static_cast<float>(row);
      const float from = side * near, to = side * (near + 2.5f);
      append_box(mesh, {{std::min(from, to), 0, -half_length + 5}, {std::max(from, to), top, half_length - 5}});
    }
  }
  const Vec3 middle{0, o.scale, 0};
  append(mesh, knot_mesh(o.detail), o.scale, middle);

  Scene scene;
  scene.meshes.push_back(std::move(mesh));
  scene.instances.push_back({0, {}});
  const Vec3 near_eye = middle + Vec3{1.2f, 1.0f, 2.4f} * o.scale, seat{40, 14, 35};
  scene.cameras = {{"close", near_eye, middle - near_eye, {0, 1, 0}, 60}, {"seat", seat, middle - seat, {0, 1, 0}, 60}};
  return scene;
}

struct Rack {
  std::uint32_t count = 64;
  std::uint32_t detail = 8;
  float spacing = 2.2f;
  std::uint32_t seed = 1;
};

/// The first `count` cells of a cube-shaped rack, filled layer by layer.
Scene rack_scene(const Rack& o) {
  std::uint32_t side = 1;
  while (std::uint64_t{side} * side * side < o.count) ++side;
  Scene scene;
  scene.meshes.push_back(knot_mesh(o.detail));
  for (std::uint32_t i = 0; i < o.count; ++i) {
    Random random(o.seed, i);
    const float u = random.uniform(), v = random.uniform(), w = random.uniform();
    Transform place = uniform_rotation(u, v, w);
    const float scale = random.uniform(0.5f, 1.0f);
    place.x = place.x * scale, place.y = place.y * scale, place.z = place.z * scale;
    const std::uint32_t layer = i / (side * side), row = i / side % side, column = i % side;
    place.translation =
        Vec3{static_cast<float>(column), static_cast<float>(layer), static_cast<float>(row)} * o.spacing;
    scene.instances.push_back({0, place});
  }
  return scene;
}

}  // namespace

Generator city_generator() {
  return mesh_generator("city", "towers of closed axis-parallel boxes",
                        OptionsOf<City>()
                            .integer("blocks", &City::blocks, 1, 2'000, "along each side, four towers each")
                            .positional()
                            .integer("seed", &City::seed, 0, 0xffffffffu, "another one, another scene"),
                        city_mesh);
}

Generator stadium_generator() {
  return scene_generator("stadium", "a teapot in a stadium: a small dense knot in a huge coarse hall",
                         OptionsOf<Stadium>()
                             .integer("detail", &Stadium::detail, 3, 3'000, "of the knot; 16 * detail^2 triangles")
                             .positional()
                             .real("scale", &Stadium::scale, 1e-4f, 20, "radius of the knot; the hall is 140 long"),
                         stadium_scene);
}

Generator instances_generator() {
  return scene_generator("instances", "a rack of instances of one knot, each turned and scaled",
                         OptionsOf<Rack>()
                             .integer("count", &Rack::count, 0, 10'000'000, "how many")
                             .positional()
                             .integer("detail", &Rack::detail, 3, 3'000, "of the knot; 16 * detail^2 triangles")
                             .real("spacing", &Rack::spacing, 0.01f, 100, "of their centres; below 2 they overlap")
                             .integer("seed", &Rack::seed, 0, 0xffffffffu, "another one, another scene"),
                         rack_scene);
}

}  // namespace boxwood
