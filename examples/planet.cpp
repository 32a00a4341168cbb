// A pebble of millimetre triangles on a ball the size of the Earth, found by rays in double precision from a metre and
// from an orbit away.
#include <boxwood/boxwood.h>

#include <cmath>
#include <cstdio>
#include <exception>
#include <vector>

using boxwood::DoubleVec3;

namespace {

struct DoubleMesh {
  std::vector<DoubleVec3> vertices;
  std::vector<boxwood::Triangle> triangles;
};

/// A sphere of `rings` by 2 `rings` cells.
void add_sphere(DoubleMesh& mesh, const DoubleVec3& center, double radius, std::uint32_t rings) {
  const double pi = std::acos(-1.0);
  const auto first = static_cast<std::uint32_t>(mesh.vertices.size()), columns = 2 * rings;
  for (std::uint32_t ring = 0; ring <= rings; ++ring) {
    for (std::uint32_t column = 0; column < columns; ++column) {
      const double theta = pi * ring / rings, phi = 2 * pi * column / columns;
      mesh.vertices.push_back({center.x + radius * std::sin(theta) * std::cos(phi),
                               center.y + radius * std::sin(theta) * std::sin(phi),
                               center.z + radius * std::cos(theta)});
    }
  }
  for (std::uint32_t ring = 0; ring < rings; ++ring) {
    for (std::uint32_t column = 0; column < columns; ++column) {
      const std::uint32_t a = first + ring * columns + column, b = first + ring * columns + (column + 1) % columns;
      mesh.triangles.push_back({a, a + columns, b + columns});
      mesh.triangles.push_back({a, b + columns, b});
    }
  }
}

boxwood::Vec3 rounded(const DoubleVec3& v) {
  return {static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z)};
}

/// What the library's single precision makes of the same mesh.
boxwood::Structure build_single(const DoubleMesh& mesh) {
  std::vector<boxwood::Vec3> vertices;
  for (const DoubleVec3& v : mesh.vertices) vertices.push_back(rounded(v));
  boxwood::Scene scene;
  scene.add_mesh(std::move(vertices), mesh.triangles);
  return boxwood::build(scene);
}

}  // namespace

int main() try {
  constexpr double earth = 6.371e6, pebble = 0.03;  // metres
  DoubleMesh mesh;
  add_sphere(mesh, {0, 0, 0}, earth, 200);
  const auto first_of_pebble = static_cast<std::uint32_t>(mesh.triangles.size());
  add_sphere(mesh, {earth + pebble, 0, 0}, pebble, 60);
  const boxwood::PreciseStructure precise = boxwood::build_precise(mesh.vertices, mesh.triangles);
  const boxwood::Structure single = build_single(mesh);
  std::printf("%zu triangles in %zu frames\n", mesh.triangles.size(), precise.frames());

  bool all_found = true;
  for (const double height : {1.0, 400e3, 3.6e7}) {
    constexpr int side = 20;  // rays down at the pebble, in a square of twice its half radius
    int found = 0, found_in_single = 0;
    double error = 0;
    for (int i = 0; i < side * side; ++i) {
      const auto across = [](int n) { return pebble * ((n + 0.5) / side - 0.5); };
      const DoubleVec3 origin{earth + height, across(i % side), across(i / side)}, down{-1, 0, 0};
      const boxwood::PreciseHit hit = precise.closest_hit({.origin = origin, .direction = down});
      const boxwood::Hit other = single.closest_hit({.origin = rounded(origin), .direction = rounded(down)});
      found += hit.valid() && hit.primitive >= first_of_pebble ? 1 : 0;
      found_in_single += other.valid() && other.primitive >= first_of_pebble ? 1 : 0;
      if (other.valid()) error = std::fmax(error, std::fabs(static_cast<double>(other.t) - hit.t));
    }
    std::printf("from %.0f m, of %d rays at the pebble: %d find it, %d in single precision, off by up to %.3f m\n",
                height, side * side, found, found_in_single, error);
    all_found = all_found && found == side * side;
  }
  return all_found ? 0 : 1;
} catch (const std::exception& error) {
  std::fprintf(stderr, "planet: %s\n", error.what());
  return 1;
}
