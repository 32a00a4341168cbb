#include "render/scattering.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "math/sampling.h"

namespace boxwood {
namespace {

/// In double, so that the last bits of the C library's powers, which differ between machines, are rounded away.
float power(float base, float exponent) {
  return static_cast<float>(std::pow(static_cast<double>(base), static_cast<double>(exponent)));
}

/// Cosine on the other side of a boundary; negative where light is reflected totally.
float squared_refracted_cosine(float cosine, float index) { return 1 - index * index * (1 - cosine * cosine); }

}  // namespace

float fresnel_reflectance(float cosine, float index) {
  const float squared = squared_refracted_cosine(cosine, index);
  if (squared <= 0) return 1;
  const float refracted = std::sqrt(squared);
  const float across = (index * cosine - refracted) / (index * cosine + refracted);
  const float along = (cosine - index * refracted) / (cosine + index * refracted);
  return (across * across + along * along) / 2;
}

Scattering::Scattering(const SurfacePoint& point, const Vec3& incoming)
    : incoming_(incoming), normal_(facing(point.normal, incoming)) {
  const Material& material = *point.material;
  const bool from_inside = dot(point.normal, incoming) > 0;
  shininess_ = std::max(material.shininess, 0.0f);
  const float index = material.refraction_index > 0 ? material.refraction_index : 1;
  index_ = from_inside ? index : 1 / index;
  share_ = {point.diffuse, material.specular, material.reflection, material.transmission};
  if (index != 1 && material.transmission != Vec3{}) {
    const float reflected = fresnel_reflectance(std::min(-dot(normal_, incoming), 1.0f), index_);
    share_[2] = share_[2] * reflected;
    share_[3] = share_[3] * (1 - reflected);
  }
  Vec3 sum;
  for (Vec3& share : share_) sum += share = max(share, {});
  if (const float most = largest(sum); most > 1) {
    for (Vec3& share : share_) share = share / most;
  }
  float total = 0;
  for (std::size_t lobe = 0; lobe < lobe_count; ++lobe) total += probability_[lobe] = largest(share_[lobe]);
  for (float& probability : probability_) probability = total > 0 ? probability / total : 0;
}

bool Scattering::spreads_light() const { return probability_[0] + probability_[1] > 0; }

Vec3 Scattering::mirror_direction() const { return incoming_ - normal_ * (2 * dot(normal_, incoming_)); }

Vec3 Scattering::evaluate(const Vec3& to_light) const {
  const float cosine = dot(normal_, to_light);
  if (!(cosine > 0)) return {};
  Vec3 sum = share_[0] * (cosine / pi);
  const float around = dot(mirror_direction(), to_light);
  if (probability_[1] > 0 && around > 0) {
    sum += share_[1] * (cosine * power(around, shininess_) * (shininess_ + 2) / (2 * pi));
  }
  return sum;
}

float Scattering::density(const Vec3& to_light) const {
  const float cosine = dot(normal_, to_light);
  if (!(cosine > 0)) return 0;
  float sum = probability_[0] * cosine / pi;
  const float around = dot(mirror_direction(), to_light);
  if (probability_[1] > 0 && around > 0) {
    sum += probability_[1] * power(around, shininess_) * (shininess_ + 1) / (2 * pi);
  }
  return sum;
}

Lobe Scattering::pick(Random& random) const {
  float at = random.uniform();
  std::size_t last = 0;
  for (std::size_t lobe = 0; lobe < lobe_count; ++lobe) {
    if (probability_[lobe] == 0) continue;
    if (at < probability_[lobe]) return static_cast<Lobe>(lobe);
    at -= probability_[lobe];
    last = lobe;
  }
  return static_cast<Lobe>(last);
}

Vec3 Scattering::spread_direction(Lobe lobe, Random& random) const {
  const float u = random.uniform(), v = random.uniform();
  if (lobe == Lobe::diffuse) return Basis(normal_).around_normal(cosine_hemisphere(u, v));
  const float cosine = power(1 - u, 1 / (shininess_ + 1));
  const float radius = std::sqrt(std::max(1 - cosine * cosine, 0.0f));
  const SineCosine around = sine_cosine_of_turns(static_cast<double>(v));
  return Basis(normalize(mirror_direction()))
      .around_normal({radius * static_cast<float>(around.cosine), radius * static_cast<float>(around.sine), cosine});
}

ScatteredRay Scattering::sample(Random& random) const {
  ScatteredRay ray;
  ray.lobe = pick(random);
  const auto lobe = static_cast<std::size_t>(ray.lobe);
  if (probability_[lobe] == 0) return ray;
  if (spreads(ray.lobe)) {
    ray.direction = spread_direction(ray.lobe, random);
    ray.density = density(ray.direction);
    if (ray.density > 0) ray.weight = evaluate(ray.direction) / ray.density;
    return ray;
  }
  ray.weight = share_[lobe] / probability_[lobe];
  if (ray.lobe == Lobe::reflection) {
    ray.direction = normalize(mirror_direction());
  } else {
    const float cosine = -dot(normal_, incoming_);
    const float refracted = std::sqrt(std::max(squared_refracted_cosine(cosine, index_), 0.0f));
    ray.direction = normalize(incoming_ * index_ + normal_ * (index_ * cosine - refracted));
  }
  return ray;
}

}  // namespace boxwood
