// The classic recursive ray tracer: Whitted 1980, "An Improved Illumination Model for Shaded Display", with Phong's
// lighting and Fresnel's shares, as in the single slab study (spec 003, 2.10). Lights cast shadows; mirrors and glass
// spawn rays down to a limited depth.
//
// Secondary rays are queued or immediate. Queued: all rays of a batch are traced, then all their shadow rays, then all
// reflected ones, then all refracted ones, whose successors go to queues that are swapped in until they are empty.
// Immediate: the same for sixteen camera rays at a time, which stay together as packets. A ray's light goes to its
// pixel in the same order either way, so the pictures are the same to the bit.
#include <algorithm>
#include <cmath>

#include "render/integrators.h"
#include "render/whitted/light_rig.h"
#include "render/whitted/optics.h"

namespace boxwood {
namespace {

constexpr std::size_t packet = 16;             // camera rays whose successors are traced at once when not queued
constexpr float least_weight = 1.0f / 512.0f;  // of a ray that is followed

/// Rays of one kind, with where their light goes.
struct RayQueue {
  std::vector<Ray> rays;
  std::vector<std::uint32_t> owners;  ///< places in the batch
  std::vector<Vec3> weights;          ///< share of the light that reaches the owner; of a shadow ray, the light itself

  void push(const Ray& ray, std::uint32_t owner, const Vec3& weight) {
    rays.push_back(ray);
    owners.push_back(owner);
    weights.push_back(weight);
  }
  void clear() {
    rays.clear();
    owners.clear();
    weights.clear();
  }
  bool empty() const { return rays.empty(); }
};

/// Phong's share of a light that arrives along `to_light` (unit, reversed): Lambert plus a lobe round the mirror
/// direction of the view.
Vec3 phong(const SurfacePoint& point, const Vec3& normal, const Vec3& view, const Vec3& to_light) {
  const float facing_light = dot(normal, to_light);
  if (!(facing_light > 0)) return {};
  const Material& material = *point.material;
  Vec3 share = point.diffuse * facing_light;
  const float along = dot(mirrored(view, normal), to_light);
  if (material.specular != Vec3{} && along > 0) share += material.specular * std::pow(along, material.shininess);
  return share;
}

/// How much of a spot's light leaves along the reverse of `to_light`.
float spot_share(const RigLight& spot, const Vec3& to_light) {
  const float cosine = -dot(spot.direction, to_light);
  const float width = std::max(spot.full_cosine - spot.dark_cosine, 1e-6f);
  return std::clamp((cosine - spot.dark_cosine) / width, 0.0f, 1.0f);
}

class WhittedBatch {
 public:
  WhittedBatch(const ShadingContext& context, Tracer& tracer, std::span<Vec3> radiance)
      : context_(context), rig_(context.rig), tracer_(tracer), radiance_(radiance) {}

  /// Camera rays [begin, begin + rays.size()) of the batch and all that follow from them.
  void trace(std::span<const Ray> rays, std::uint32_t begin) {
    RayQueue& primary = reflected_;  // the queue is free at the start
    for (std::size_t i = 0; i < rays.size(); ++i) {
      primary.push(rays[i], begin + static_cast<std::uint32_t>(i), {1, 1, 1});
    }
    const char* kind = "primary";
    for (std::uint32_t depth = 0; !reflected_.empty() || !refracted_.empty(); ++depth) {
      std::swap(reflected_, reflected_now_);
      std::swap(refracted_, refracted_now_);
      const bool may_spawn = depth < context_.settings.depth;
      shade(kind, reflected_now_, may_spawn);
      shade("refraction", refracted_now_, may_spawn);
      kind = "reflection";
    }
  }

 private:
  void shade(const char* kind, RayQueue& queue, bool may_spawn) {
    if (queue.empty()) return;
    hits_.resize(queue.rays.size());
    tracer_.closest_hits(kind, queue.rays, hits_);
    for (std::size_t i = 0; i < hits_.size(); ++i) {
      if (!hits_[i].valid()) continue;
      const SurfacePoint point = context_.surfaces.at(hits_[i]);
      const Vec3& weight = queue.weights[i];
      const Vec3 view = normalize(queue.rays[i].direction);
      const Vec3 normal = facing(point.normal, view);
      const Vec3 glow = point.material->emits_behind || dot(point.normal, view) < 0 ? point.material->emission : Vec3{};
      radiance_[queue.owners[i]] += weight * (glow + point.diffuse * rig_.ambient);
      light(point, normal, view, queue.owners[i], weight);
      if (may_spawn) spawn(point, normal, view, queue.owners[i], weight);
    }
    queue.clear();
    trace_shadows();
  }

  /// Queues a shadow ray for every light that would add something.
  void light(const SurfacePoint& point, const Vec3& normal, const Vec3& view, std::uint32_t owner, const Vec3& weight) {
    const Vec3 origin = point.position + normal * point.clearance;
    for (const RigLight& rig_light : rig_.lights) {
      const Vec3 way = rig_light.parallel ? -rig_light.direction : rig_light.position - origin;
      const Vec3 to_light = normalize(way);
      Vec3 arriving = rig_light.intensity;
      if (rig_light.fades) {
        arriving = arriving / std::max(dot(way, way), 1e-12f);
        if (rig_light.normal != Vec3{}) arriving = arriving * std::max(0.0f, -dot(rig_light.normal, to_light));
      }
      if (rig_light.dark_cosine > -1) arriving = arriving * spot_share(rig_light, to_light);
      const Vec3 color = weight * arriving * phong(point, normal, view, to_light);
      if (!(largest(color) > 0)) continue;
      Ray ray{origin, 0, way};
      if (!rig_light.parallel) ray.t_far = 1;
      shadows_.push(ray, owner, color);
    }
  }

  void trace_shadows() {
    if (shadows_.empty()) return;
    blocked_.resize(shadows_.rays.size());
    tracer_.any_hits("shadow", shadows_.rays, blocked_);
    for (std::size_t i = 0; i < blocked_.size(); ++i) {
      if (!blocked_[i]) radiance_[shadows_.owners[i]] += shadows_.weights[i];
    }
    shadows_.clear();
  }

  void spawn(const SurfacePoint& point, const Vec3& normal, const Vec3& view, std::uint32_t owner, const Vec3& weight) {
    const Material& material = *point.material;
    Vec3 reflection = material.reflection, transmission = material.transmission;
    Vec3 onward = view;
    if (transmission != Vec3{} && material.refraction_index > 0 && material.refraction_index != 1) {
      const bool entering = dot(point.normal, view) < 0;
      const Refraction refraction =
          refracted(view, normal, entering ? 1 / material.refraction_index : material.refraction_index);
      onward = refraction.direction;
      // What cannot leave is mirrored whole.
      const Vec3 mirror = refraction.reflectance == 1 ? Vec3{1, 1, 1} : max(reflection, transmission);
      reflection = mirror * refraction.reflectance;
      transmission = transmission * (1 - refraction.reflectance);
    }
    const Vec3 in_mirror = weight * reflection, through = weight * transmission;
    if (largest(in_mirror) >= least_weight) {
      reflected_.push({point.position + normal * point.clearance, 0, mirrored(view, normal)}, owner, in_mirror);
    }
    if (largest(through) >= least_weight) {
      refracted_.push({point.position - normal * point.clearance, 0, onward}, owner, through);
    }
  }

  const ShadingContext& context_;
  const LightRig& rig_;
  Tracer& tracer_;
  std::span<Vec3> radiance_;
  RayQueue reflected_, refracted_;          // what is to be traced next
  RayQueue reflected_now_, refracted_now_;  // what is being traced
  RayQueue shadows_;
  std::vector<Hit> hits_;
  std::vector<std::uint8_t> blocked_;
};

void shade(const ShadingContext& context, const CameraBatch& batch, Tracer& tracer, std::span<Vec3> radiance) {
  std::ranges::fill(radiance, Vec3{});
  WhittedBatch whitted(context, tracer, radiance);
  const std::size_t size = context.settings.secondary == SecondaryRays::queued ? batch.rays.size() : packet;
  for (std::size_t begin = 0; begin < batch.rays.size(); begin += size) {
    whitted.trace(batch.rays.subspan(begin, std::min(size, batch.rays.size() - begin)),
                  static_cast<std::uint32_t>(begin));
  }
}

}  // namespace

Integrator whitted_integrator() {
  return {"whitted", "Phong lighting, hard and soft shadows, mirrors and glass, to a limited depth", shade, nullptr};
}

}  // namespace boxwood
