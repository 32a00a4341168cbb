#include "trace/scalar_targets.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "trace/brute_force.cpp"
#include <hwy/foreach_target.h>
//
#include "trace/brute_force.h"
#include "trace/object_ray.h"
#include "trace/triangle-inl.h"

HWY_BEFORE_NAMESPACE();
namespace boxwood {
namespace HWY_NAMESPACE {

Hit closest_of_all(const BruteForce::Data& data, const Ray& ray, std::uint32_t mask) {
  Hit best;
  if (!within_limits(ray)) return best;
  for (std::uint32_t i = 0; i < data.instances.size(); ++i) {
    const BruteForce::Placed& placed = data.instances[i];
    if ((placed.mask & mask) == 0) continue;
    const PreparedRay prepared = prepare(placed.identity ? ray : object_ray(placed.world_to_object, ray), 0);
    if (!prepared.valid) continue;
    for (std::uint32_t t = 0; t < placed.count; ++t) closest_of(data.triangles[placed.first + t], prepared, i, best);
  }
  return best;
}

bool any_of_all(const BruteForce::Data& data, const Ray& ray, std::uint32_t mask) {
  if (!within_limits(ray)) return false;
  for (const BruteForce::Placed& placed : data.instances) {
    if ((placed.mask & mask) == 0) continue;
    const PreparedRay prepared = prepare(placed.identity ? ray : object_ray(placed.world_to_object, ray), 0);
    if (!prepared.valid) continue;
    for (std::uint32_t t = 0; t < placed.count; ++t) {
      if (blocks(data.triangles[placed.first + t], prepared)) return true;
    }
  }
  return false;
}

void append_all(const BruteForce::Data& data, const Ray& ray, std::uint32_t mask, std::vector<Hit>& hits) {
  if (!within_limits(ray)) return;
  for (std::uint32_t i = 0; i < data.instances.size(); ++i) {
    const BruteForce::Placed& placed = data.instances[i];
    if ((placed.mask & mask) == 0) continue;
    const PreparedRay prepared = prepare(placed.identity ? ray : object_ray(placed.world_to_object, ray), 0);
    if (!prepared.valid) continue;
    for (std::uint32_t t = 0; t < placed.count; ++t) {
      Hit hit;
      if (closest_of(data.triangles[placed.first + t], prepared, i, hit)) hits.push_back(hit);
    }
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace boxwood
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include <algorithm>

#include "trace/hit_sink.h"

namespace boxwood {

HWY_EXPORT(closest_of_all);
HWY_EXPORT(any_of_all);
HWY_EXPORT(append_all);

namespace {

void check_same_length(std::size_t rays, std::size_t answers) {
  if (rays != answers) throw UsageError(fmt::format("{} rays need as many answers, not {}", rays, answers));
}

}  // namespace

BruteForce::BruteForce(const Scene& scene) {
  std::vector<Placed> meshes;
  for (const Mesh& mesh : scene.meshes) {
    Placed range;
    range.first = static_cast<std::uint32_t>(data_.triangles.size());
    for (std::uint32_t i = 0; i < mesh.triangles.size(); ++i) {
      if (!is_usable(mesh, i)) continue;
      const auto& [a, b, c] = mesh.triangles[i];
      data_.triangles.push_back({mesh.positions[a], mesh.positions[b], mesh.positions[c], i});
    }
    range.count = static_cast<std::uint32_t>(data_.triangles.size()) - range.first;
    meshes.push_back(range);
  }
  // One level is traced as it stands, without a map; two levels map the ray for every instance.
  const bool identity = scene.single_level();
  for (const Instance& instance : scene.instances) {
    Placed placed = meshes[instance.mesh];
    placed.identity = identity;
    placed.mask = instance.mask;
    if (!identity && placed.count > 0) placed.world_to_object = instance.object_to_world.inverse();
    data_.instances.push_back(placed);
  }
}

Hit BruteForce::closest_hit(const Ray& ray, std::uint32_t mask) const {
  return HWY_DYNAMIC_DISPATCH(closest_of_all)(data_, ray, mask);
}

bool BruteForce::any_hit(const Ray& ray, std::uint32_t mask) const {
  return HWY_DYNAMIC_DISPATCH(any_of_all)(data_, ray, mask);
}

std::vector<Hit> BruteForce::all_hits(const Ray& ray, std::uint32_t mask) const {
  std::vector<Hit> hits;
  HWY_DYNAMIC_DISPATCH(append_all)(data_, ray, mask, hits);
  std::ranges::sort(hits, comes_before);
  return hits;
}

void BruteForce::closest_hits(std::span<const Ray> rays, std::span<Hit> hits) const {
  check_same_length(rays.size(), hits.size());
  tbb::parallel_for(std::size_t{0}, rays.size(), [&](std::size_t i) { hits[i] = closest_hit(rays[i]); });
}

void BruteForce::any_hits(std::span<const Ray> rays, std::span<std::uint8_t> blocked) const {
  check_same_length(rays.size(), blocked.size());
  tbb::parallel_for(std::size_t{0}, rays.size(), [&](std::size_t i) { blocked[i] = any_hit(rays[i]) ? 1 : 0; });
}

}  // namespace boxwood
#endif
