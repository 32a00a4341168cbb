// A pebble of millimetre triangles above a ball the size of the Earth, found by rays in double precision from a metre
// and from orbits away, and what single precision makes of it.
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
  const DoubleVec3 up{0.36, 0.48, 0.8}, east{0.8, -0.6, 0}, north{0.48, 0.64, -0.6};  // each of length 1
  add_sphere(mesh, up * (earth + 10), pebble, 60);
  const boxwood::PreciseStructure precise = boxwood::build_precise(mesh.vertices, mesh.triangles);
  const boxwood::Structure single = build_single(mesh);
  std::printf("%zu triangles in %zu frames\n", mesh.triangles.size(), precise.frames());

  bool all_found = true;
  for (const double height : {1.0, 400e3, 3.6e7}) {
    constexpr int side = 20;  // rays down at the pebble, over a square of its radius
    int found = 0, found_in_single = 0;
    double error = 0;  // metres, at the ground a kilometre beside it
    for (int i = 0; i < side * side; ++i) {
      const auto across = [](int n) { return pebble * ((n + 0.5) / side - 0.5); };
      const DoubleVec3 origin = up * (earth + 10 + height) + east * across(i % side) + north * across(i / side);
      const DoubleVec3 down = up * -1, beside = origin + east * (1000 + i);
      const boxwood::PreciseHit hit = precise.closest_hit({.origin = origin, .direction = down});
      const boxwood::Hit other = single.closest_hit({.origin = rounded(origin), .direction = rounded(down)});
      if (hit.valid() && hit.primitive >= first_of_pebble) ++found;
      if (other.valid() && other.primitive >= first_of_pebble) ++found_in_single;
      const double ground = precise.closest_hit({.origin = beside, .direction = down}).t;
      const float rough = single.closest_hit({.origin = rounded(beside), .direction = rounded(down)}).t;
      error = std::fmax(error, std::fabs(static_cast<double>(rough) - ground));
    }
    std::printf(
        "from %.0f m, of %d rays at the pebble: %d find it, %d in single precision, whose ground is up to %.2f m off\n",
        height, side * side, found, found_in_single, error);
    all_found = all_found && found == side * side;
  }
  return all_found ? 0 : 1;
} catch (const std::exception& error) {
  std::fprintf(stderr, "planet: %s\n", error.what());
  return 1;
}
