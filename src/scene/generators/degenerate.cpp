// What breaks builders that were not made for it.
#include <limits>

#include "math/random.h"
#include "scene/generators/generator.h"
#include "scene/generators/shapes.h"

namespace boxwood {
namespace {

struct Nothing {};

struct Count {
  std::uint32_t triangles = 1'000;
};

struct Seeded {
  std::uint32_t triangles = 1'000;
  std::uint32_t seed = 1;
};

OptionsOf<Count> count_options() {
  OptionsOf<Count> options;
  options.integer("triangles", &Count::triangles, 0, 100'000'000, "how many").positional();
  return options;
}

OptionsOf<Seeded> seeded_options() {
  OptionsOf<Seeded> options;
  options.integer("triangles", &Seeded::triangles, 0, 100'000'000, "how many")
      .positional()
      .integer("seed", &Seeded::seed, 0, 0xffffffffu, "another one, another scene");
  return options;
}

/// `make(random, i, vertices)` fills the three vertices of triangle i.
template <class Options, class Make>
Mesh seeded_mesh(const Options& o, const Make& make) {
  Mesh mesh;
  for (std::uint32_t i = 0; i < o.triangles; ++i) {
    Random random(o.seed, i);
    Vec3 v[3];
    make(random, i, v);
    append_triangle(mesh, v[0], v[1], v[2]);
  }
  return mesh;
}

Mesh coincident_mesh(const Count& o) {
  Mesh mesh;
  for (std::uint32_t i = 0; i < o.triangles; ++i) append_triangle(mesh, {0, 0, 0}, {1, 0, 0}, {0, 1, 0});
  return mesh;
}

Mesh coplanar_mesh(const Seeded& o) {
  return seeded_mesh(o, [](Random& random, std::uint32_t, Vec3(&v)[3]) {
    const float x = random.uniform(0, 0.9f), y = random.uniform(0, 0.9f);
    for (Vec3& vertex : v) {
      vertex.x = x + random.uniform(0, 0.1f);
      vertex.y = y + random.uniform(0, 0.1f);
    }
  });
}

/// Each triangle is the one before it, shrunk towards the common centre of all triangles and all boxes.
Mesh nested_mesh(const Count& o) {
  Mesh mesh;
  for (std::uint32_t i = 0; i < o.triangles; ++i) {
    const float s = 1 - static_cast<float>(i) / static_cast<float>(o.triangles + 1);
    append_triangle(mesh, {-s, 0, s}, {s, -s, 0}, {0, s, -s});
  }
  return mesh;
}

/// By turns a point, a segment with a vertex used twice, and three points on a line. Whole numbers, so that the area is
/// zero exactly.
Mesh zero_area_mesh(const Seeded& o) {
  return seeded_mesh(o, [](Random& random, std::uint32_t i, Vec3(&v)[3]) {
    const auto whole = [&] {
      const auto x = static_cast<float>(random.below(1024)), y = static_cast<float>(random.below(1024));
      return Vec3{x, y, static_cast<float>(random.below(1024))};
    };
    v[0] = whole();
    const Vec3 step = i % 3 == 0 ? Vec3{} : whole();
    v[1] = v[0] + step;
    v[2] = i % 3 == 2 ? v[1] + step : v[1];
  });
}

/// Of every four triangles one has a NaN, one an infinite and one a too large coordinate; the fourth is sound.
Mesh non_finite_mesh(const Seeded& o) {
  return seeded_mesh(o, [](Random& random, std::uint32_t i, Vec3(&v)[3]) {
    for (Vec3& vertex : v) vertex = uniform_point(random, 0, 1);
    constexpr float bad[3] = {std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity(),
                              largest_coordinate * 2};
    const std::uint32_t vertex = random.below(3), axis = random.below(3);
    if (i % 4 < 3) v[vertex][axis] = bad[i % 4];
  });
}

Mesh huge_mesh(const Seeded& o) {
  return seeded_mesh(o, [](Random& random, std::uint32_t, Vec3(&v)[3]) {
    for (Vec3& vertex : v) vertex = uniform_point(random, -largest_coordinate, largest_coordinate);
  });
}

}  // namespace

Generator single_generator() {
  return mesh_generator<Nothing>("single", "one triangle", {}, [](const Nothing&) { return coincident_mesh({1}); });
}

Generator none_generator() {
  return mesh_generator<Nothing>("none", "no triangle", {}, [](const Nothing&) { return Mesh{}; });
}

Generator coincident_generator() {
  return mesh_generator("coincident", "the same triangle many times", count_options(), coincident_mesh);
}

Generator coplanar_generator() {
  return mesh_generator("coplanar", "random triangles in the plane z = 0", seeded_options(), coplanar_mesh);
}

Generator nested_generator() {
  return mesh_generator("nested", "triangles with a common centroid, each inside the one before", count_options(),
                        nested_mesh);
}

Generator zero_area_generator() {
  return mesh_generator("zero-area", "points and lines: nothing that can be hit", seeded_options(), zero_area_mesh);
}

Generator non_finite_generator() {
  return mesh_generator("non-finite", "three triangles in four have a NaN, infinite or too large coordinate",
                        seeded_options(), non_finite_mesh);
}

Generator huge_generator() {
  return mesh_generator("huge", "random triangles with coordinates up to 1e12", seeded_options(), huge_mesh);
}

}  // namespace boxwood
