#include "soak/random_scene.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <numbers>

#include "math/sampling.h"

namespace boxwood {
namespace {

Vec3 point(Random& random, float size) {
  const float x = random.uniform(-size, size), y = random.uniform(-size, size);
  return {x, y, random.uniform(-size, size)};
}

using Maker = Mesh (*)(std::uint32_t triangles, Random& random);

Mesh soup_of(std::uint32_t triangles, float size, Random& random) {
  Mesh mesh;
  for (std::uint32_t i = 0; i < triangles; ++i) {
    const Vec3 centre = point(random, 1);
    for (int corner = 0; corner < 3; ++corner) mesh.positions.push_back(centre + point(random, size));
    mesh.triangles.push_back({3 * i, 3 * i + 1, 3 * i + 2});
  }
  return mesh;
}

Mesh soup(std::uint32_t triangles, Random& random) {
  return soup_of(triangles, std::exp2(random.uniform(-5, 1)), random);
}

Mesh slivers(std::uint32_t triangles, Random& random) {
  Mesh mesh = soup(triangles, random);
  const float squeeze = std::exp2(random.uniform(-40, 0));
  const std::uint32_t axis = random.below(3);
  for (Vec3& p : mesh.positions) p[axis] *= squeeze;
  return mesh;
}

Mesh copies(std::uint32_t triangles, Random& random) {
  Mesh mesh = soup(1 + random.below(3), random);
  const auto kinds = static_cast<std::uint32_t>(mesh.triangles.size());
  while (mesh.triangles.size() < triangles) mesh.triangles.push_back(mesh.triangles[random.below(kinds)]);
  return mesh;
}

/// Vertices on a coarse lattice: many coincide, many triangles are coplanar or degenerate.
Mesh lattice(std::uint32_t triangles, Random& random) {
  Mesh mesh = soup(triangles, random);
  const float cells = static_cast<float>(1 + random.below(6));
  for (Vec3& p : mesh.positions) {
    for (std::size_t axis = 0; axis < 3; ++axis) p[axis] = std::round(p[axis] * cells) / cells;
  }
  return mesh;
}

Mesh grid(std::uint32_t triangles, Random& random) {
  const auto side = static_cast<std::uint32_t>(std::sqrt(static_cast<float>(triangles) / 2)) + 1;
  const float bumps = random.below(2) ? random.uniform(0, 0.3f) : 0;
  Mesh mesh;
  for (std::uint32_t i = 0; i <= side; ++i) {
    for (std::uint32_t j = 0; j <= side; ++j) {
      const auto at = [&](std::uint32_t n) { return 2 * static_cast<float>(n) / static_cast<float>(side) - 1; };
      mesh.positions.push_back({at(i), bumps * random.uniform(-1, 1), at(j)});
    }
  }
  for (std::uint32_t i = 0; i < side; ++i) {
    for (std::uint32_t j = 0; j < side; ++j) {
      const std::uint32_t a = i * (side + 1) + j, b = a + side + 1;
      mesh.triangles.push_back({a, b, b + 1});
      mesh.triangles.push_back({a, b + 1, a + 1});
    }
  }
  return mesh;
}

/// Ever smaller triangles towards a point, which makes deep trees.
Mesh cascade(std::uint32_t triangles, Random& random) {
  Mesh mesh = soup(triangles, random);
  const float ratio = random.uniform(0.3f, 0.95f);
  float scale = 1;
  for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
    mesh.positions[i] = mesh.positions[i] * scale;
    if (i % 3 == 2) scale *= ratio;
  }
  return mesh;
}

Mesh wild(std::uint32_t triangles, Random& random) {
  Mesh mesh = soup(triangles, random);
  for (Vec3& p : mesh.positions) {
    if (random.below(4) == 0) p[random.below(3)] = arbitrary_float(random);
  }
  return mesh;
}

struct Kind {
  const char* name;
  Maker make;
};
constexpr Kind kinds[] = {{"soup", soup}, {"slivers", slivers}, {"copies", copies}, {"lattice", lattice},
                          {"grid", grid}, {"cascade", cascade}, {"wild", wild}};

std::uint32_t random_size(Random& random) {
  constexpr std::uint32_t most[] = {1, 3, 10, 60, 300};
  return random.below(most[random.below(5)] + 1);
}

void place_in_world(Mesh& mesh, Random& random) {
  constexpr float scales[] = {1, 1, 1, 1e-6f, 1e6f, 1e-14f, 4e11f};
  const float scale = scales[random.below(7)];
  const Vec3 offset = random.below(3) == 0 ? point(random, 1e4f * scale) : Vec3{};
  for (Vec3& p : mesh.positions) p = p * scale + offset;
}

Transform random_transform(Random& random) {
  const float u = random.uniform(), v = random.uniform();
  Transform out = Transform::translate(point(random, 4)) * uniform_rotation(u, v, random.uniform());
  if (random.below(2)) out = out * Transform::scale(point(random, 3) + Vec3{0.01f, 0.01f, 0.01f});
  if (random.below(8) == 0) out = out * Transform::scale({1, 1e-4f, 1e3f});
  return out;
}

Vec3 some_vertex(const Scene& scene, Random& random) {
  const Instance& instance = scene.instances[random.below(static_cast<std::uint32_t>(scene.instances.size()))];
  const Mesh& mesh = scene.meshes[instance.mesh];
  if (mesh.triangles.empty()) return {};
  const Triangle& triangle = mesh.triangles[random.below(static_cast<std::uint32_t>(mesh.triangles.size()))];
  return instance.object_to_world.point(mesh.positions[triangle[random.below(3)]]);
}

float awkward(Random& random) {
  constexpr float values[] = {0, -0.0f, 1, -1, 1e-45f, -1e-40f, 1e-38f, -1e-30f, 1e-20f, -1e-10f, 1e-7f};
  return values[random.below(11)];
}

Ray random_ray(const Scene& scene, const Box& around, Random& random) {
  const Vec3 a = some_vertex(scene, random), b = some_vertex(scene, random);
  const float size = std::max({around.extent().x, around.extent().y, around.extent().z, 1e-30f});
  Ray ray;
  ray.origin = around.center() + point(random, random.below(2) ? 0.5f * size : 2 * size);
  ray.direction = point(random, 1);
  switch (random.below(6)) {
    case 0:
      ray.direction = (a - ray.origin) * (1 / size);
      break;
    case 1:
      ray.direction = (a + (b - a) * random.uniform() - ray.origin) * (1 / size);
      break;
    case 2:
      ray.origin = random.below(2) ? a : ray.origin;
      for (std::size_t axis = 0; axis < 3; ++axis) ray.direction[axis] = awkward(random);
      break;
    case 3:
      ray.origin = a;
      ray.direction = (b - a) * (1 / size);
      break;
    case 4:
      ray.origin[random.below(3)] = a[random.below(3)];
      break;
    default:
      break;
  }
  if (random.below(4) == 0) ray.t_near = random.uniform(-1, 1) * size;
  if (random.below(4) == 0) ray.t_far = ray.t_near + random.uniform(-0.1f, 3) * size;
  if (random.below(16) == 0) ray.direction[random.below(3)] = arbitrary_float(random);
  if (random.below(16) == 0) ray.origin[random.below(3)] = arbitrary_float(random);
  return ray;
}

}  // namespace

float arbitrary_float(Random& random) {
  constexpr std::uint32_t special[] = {0x7fc00000, 0x7f800000, 0xff800000, 0x00000001,
                                       0x807fffff, 0x7f7fffff, 0x80000000};
  return std::bit_cast<float>(random.below(3) == 0 ? special[random.below(7)] : random.bits());
}

Scene random_scene(Random& random) {
  Scene scene;
  const std::uint32_t meshes = random.below(4) == 0 ? 1 + random.below(3) : 1;
  for (std::uint32_t m = 0; m < meshes; ++m) {
    const Kind& kind = kinds[random.below(std::size(kinds))];
    scene.meshes.push_back(kind.make(random_size(random), random));
    if (meshes == 1) place_in_world(scene.meshes.back(), random);
    scene.name += fmt::format("{}{}({})", m == 0 ? "" : " + ", kind.name, scene.meshes.back().triangles.size());
    scene.instances.push_back({m, {}});
  }
  if (meshes > 1 || random.below(6) == 0) {
    scene.instances.clear();
    for (std::uint32_t n = 1 + random.below(12); n > 0; --n) {
      scene.instances.push_back({random.below(meshes), random_transform(random)});
    }
    scene.name += fmt::format(" in {} instances", scene.instances.size());
  }
  return scene;
}

std::vector<Ray> random_rays_at(const Scene& scene, std::uint32_t count, Random& random) {
  Box around = scene.bounds();
  if (around.empty()) around = {{-1, -1, -1}, {1, 1, 1}};
  std::vector<Ray> rays;
  for (std::uint32_t i = 0; i < count; ++i) rays.push_back(random_ray(scene, around, random));
  return rays;
}

}  // namespace boxwood
