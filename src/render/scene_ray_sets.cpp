// Ray sets that probe a structure without a camera: anywhere, along the axes, along surfaces.
#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>

#include "math/sampling.h"
#include "render/ray_sets.h"
#include "render/sample_random.h"
#include "render/secondary_rays.h"

namespace boxwood {
namespace {

/// settings.random_rays rays, each made from random numbers of its own.
template <class Make>
std::vector<Ray> independent_rays(const RaySetContext& context, RandomUse use, const Make& make) {
  if (context.bounds.empty()) return {};
  std::vector<Ray> rays(context.settings.random_rays);
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, rays.size(), 4096), [&](const auto& range) {
    for (std::size_t i = range.begin(); i < range.end(); ++i) {
      Random random = sample_random(context.settings.seed, use, static_cast<std::uint32_t>(i));
      rays[i] = make(random);
    }
  });
  return rays;
}

Vec3 point_in(const Box& box, Random& random) {
  const float x = random.uniform(box.lower.x, box.upper.x);
  const float y = random.uniform(box.lower.y, box.upper.y);
  const float z = random.uniform(box.lower.z, box.upper.z);
  return {x, y, z};
}

/// Picks among all placed triangles, all equally likely.
class TrianglePicker {
 public:
  explicit TrianglePicker(const Scene& scene) : scene_(scene) {
    std::uint64_t placed = 0;
    for (const Instance& instance : scene.instances) {
      placed += scene.meshes[instance.mesh].triangles.size();
      ends_.push_back(placed);
    }
  }

  struct Place {
    std::uint32_t instance, triangle;
  };

  /// A usable triangle. Scenes where a random one is hardly ever usable give the first usable one instead.
  Place pick(Random& random) const {
    constexpr int attempts = 64;
    for (int attempt = 0; attempt < attempts; ++attempt) {
      const std::uint64_t bits = (std::uint64_t{random.bits()} << 32) | random.bits();
      const Place place = place_of(bits % ends_.back());
      if (usable(place)) return place;
    }
    for (std::uint64_t number = 0;; ++number) {  // ends: a scene whose bounds are not empty has one
      const Place place = place_of(number);
      if (usable(place)) return place;
    }
  }

 private:
  Place place_of(std::uint64_t number) const {
    const auto end = std::ranges::upper_bound(ends_, number);
    const std::uint64_t begin = end == ends_.begin() ? 0 : *(end - 1);
    return {static_cast<std::uint32_t>(end - ends_.begin()), static_cast<std::uint32_t>(number - begin)};
  }
  bool usable(const Place& place) const {
    return is_usable(scene_.meshes[scene_.instances[place.instance].mesh], place.triangle);
  }

  const Scene& scene_;
  std::vector<std::uint64_t> ends_;  // [i] = triangles placed by instances 0 … i
};

}  // namespace

std::vector<Ray> random_rays(const RaySetContext& context) {
  return independent_rays(context, RandomUse::random_ray, [&](Random& random) {
    Ray ray;
    ray.origin = point_in(context.bounds, random);
    const float u = random.uniform(), v = random.uniform();
    ray.direction = uniform_sphere(u, v);
    return ray;
  });
}

std::vector<Ray> axis_rays(const RaySetContext& context) {
  return independent_rays(context, RandomUse::axis_ray, [&](Random& random) {
    Ray ray;
    ray.origin = point_in(context.bounds, random);
    const std::uint32_t axis = random.below(3);
    const std::uint32_t signs = random.bits();
    for (std::uint32_t a = 0; a < 3; ++a) {
      ray.direction[a] = std::copysign(a == axis ? 1.0f : 0.0f, (signs >> (29 + a)) & 1 ? -1.0f : 1.0f);
    }
    return ray;
  });
}

std::vector<Ray> grazing_rays(const RaySetContext& context) {
  constexpr float largest_angle = 0.01f;  // radians, to first order
  const TrianglePicker picker(context.scene);
  return independent_rays(context, RandomUse::grazing_ray, [&](Random& random) {
    const auto [instance, triangle] = picker.pick(random);
    const float root = std::sqrt(random.uniform()), across = random.uniform();
    const SurfacePoint point = context.surfaces.at(instance, triangle, root * (1 - across), root * across);
    const SineCosine around = sine_cosine_of_turns(static_cast<double>(random.uniform()));
    const Vec3 local{static_cast<float>(around.cosine), static_cast<float>(around.sine),
                     random.uniform(-largest_angle, largest_angle)};
    Ray ray;
    ray.origin = point.position + point.normal * point.clearance;
    ray.direction = normalize(Basis(point.normal).around_normal(local));
    return ray;
  });
}

}  // namespace boxwood
