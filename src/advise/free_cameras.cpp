#include "advise/free_cameras.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "math/random.h"
#include "math/sampling.h"

namespace boxwood {
namespace {

constexpr std::uint32_t points = 256, directions = 64;
constexpr float least_clearance = 0.005f;  ///< of the scene's diagonal
constexpr float least_seen = 0.5f;         ///< of the directions: fewer hits are a view from outside
constexpr float most_backs = 0.6f;         ///< of the hits
constexpr float cone = 0.8f;               ///< cosine of half the angle of a view, about

struct Spot {
  Vec3 eye, direction;
  float worth = 0;
};

Vec3 direction_number(std::uint32_t i) {
  // A spiral: even over the sphere (Swinbank and Purser 2006).
  const float turns = 0.61803398875f * static_cast<float>(i);
  return uniform_sphere((static_cast<float>(i) + 0.5f) / directions, turns - std::floor(turns));
}

bool shows_its_back(const Scene& scene, const Hit& hit, const Vec3& direction) {
  const Instance& instance = scene.instances[hit.instance];
  const Mesh& mesh = scene.meshes[instance.mesh];
  const auto& [a, b, c] = mesh.triangles[hit.primitive];
  const auto corner = [&](std::uint32_t vertex) { return instance.object_to_world.point(mesh.positions[vertex]); };
  return dot(cross(corner(b) - corner(a), corner(c) - corner(a)), direction) > 0;
}

/// What can be seen from `eye`; nothing when it is no place to stand.
std::optional<Spot> look_around(const Scene& scene, const Structure& structure, const Vec3& eye, float diagonal) {
  float distances[directions] = {};
  std::uint32_t seen = 0, backs = 0;
  for (std::uint32_t i = 0; i < directions; ++i) {
    Ray ray;
    ray.origin = eye;
    ray.direction = direction_number(i);
    const Hit hit = structure.closest_hit(ray);
    if (!hit.valid()) continue;
    if (hit.t < least_clearance * diagonal) return {};
    distances[i] = hit.t / diagonal;
    ++seen;
    backs += shows_its_back(scene, hit, ray.direction) ? 1 : 0;
  }
  if (static_cast<float>(seen) < least_seen * directions) return {};
  if (static_cast<float>(backs) > most_backs * static_cast<float>(seen)) return {};
  Spot best{eye, {0, 0, -1}, 0};
  for (std::uint32_t i = 0; i < directions; ++i) {
    const Vec3 direction = direction_number(i);
    if (std::fabs(direction.y) > 0.5f) continue;  // neither at the floor nor at the sky
    float worth = 0;
    for (std::uint32_t j = 0; j < directions; ++j) {
      if (dot(direction, direction_number(j)) > cone) worth += std::sqrt(distances[j]);
    }
    if (worth > best.worth) best = {eye, direction, worth};
  }
  return best;
}

}  // namespace

std::vector<Camera> free_cameras(const Scene& scene, const Structure& structure, std::uint32_t count,
                                 std::uint64_t seed) {
  const Box box = scene.bounds();
  if (box.empty()) return {};
  const float diagonal = length(box.extent());
  std::vector<Spot> spots;
  for (std::uint32_t i = 0; i < points; ++i) {
    Random random(seed, i);
    Vec3 eye;
    for (std::size_t axis = 0; axis < 3; ++axis) eye[axis] = random.uniform(box.lower[axis], box.upper[axis]);
    if (const auto spot = look_around(scene, structure, eye, diagonal)) spots.push_back(*spot);
  }
  std::vector<Camera> cameras;
  while (cameras.size() < count && !spots.empty()) {
    // Worth much and far from those that were taken.
    const auto value = [&](const Spot& spot) {
      float nearest = diagonal;
      for (const Camera& camera : cameras) nearest = std::min(nearest, length(spot.eye - camera.eye));
      return spot.worth * nearest;
    };
    const auto best = std::ranges::max_element(spots, {}, value);
    if (value(*best) <= 0) break;
    Camera camera;
    camera.name = fmt::format("free-{}", cameras.size());
    camera.eye = best->eye;
    camera.direction = best->direction;
    camera.fov = 70;
    cameras.push_back(camera);
    spots.erase(best);
  }
  return cameras;
}

}  // namespace boxwood
