#pragma once
#include <cstdint>
#include <vector>

#include "boxwood/scene.h"
#include "math/random.h"
#include "render/surface.h"

namespace boxwood {

/// One way from a point to a light, picked at random.
struct LightSample {
  Vec3 target;            ///< a point on the light or, when it is far away, the unit direction to it
  bool far_away = false;  ///< a distant light or the sky
  Vec3 direction;         ///< unit, from the point to the light
  /// What arrives if nothing is in the way, divided by the density: its mean is the integral of radiance over solid
  /// angle. Zero for the dark side of a surface.
  Vec3 light;
  /// Probability density per solid angle of having picked this direction; 0 for lights that no ray can find by chance
  /// (point, spot, distant).
  float density = 0;
};

/// Everything in a scene that gives light, to be sampled: lights without a surface, the sky, and surfaces with an
/// emission. One of these three families is picked evenly among those that the scene has; within a family, lights
/// evenly and surfaces by area times luminance. Refers to the scene and to the surfaces.
class Lights {
 public:
  /// `fallback` lights a scene that has no light at all. O(triangles) when some material emits.
  Lights(const Scene& scene, const Surfaces& surfaces, const Light& fallback);

  /// From `point` on a surface with the unit normal `normal` on the side that is to be lit.
  LightSample sample(const Vec3& point, const Vec3& normal, Random& random) const;

  /// Radiance of the sky.
  const Vec3& sky() const { return sky_; }
  /// Density with which sample() picks `direction` at a surface with that normal for the sky.
  float sky_density(const Vec3& normal, const Vec3& direction) const;
  /// Radiance that a surface sends against `direction`, the unit direction in which it is seen.
  static Vec3 emission(const SurfacePoint& surface, const Vec3& direction);
  /// Density with which sample() picks, from a point `distance` away in `direction`, that place of an emitting surface.
  float surface_density(const SurfacePoint& surface, const Vec3& direction, float distance) const;

 private:
  struct Emitter {
    std::uint32_t instance, triangle;
    double weights;  ///< of this triangle and all before it
  };
  void add_surfaces(const Scene& scene);
  LightSample sample_lights(const Vec3& point, Random& random) const;
  LightSample sample_sky(const Vec3& normal, Random& random) const;
  LightSample sample_surfaces(const Vec3& point, Random& random) const;

  const Surfaces& surfaces_;
  std::vector<Light> lights_;  // without skies
  Vec3 sky_;
  std::vector<Emitter> emitters_;
  std::uint32_t families_ = 0;  // that there are
};

/// Weight of the three colours for the eye (ITU-R BT.709).
constexpr float luminance(const Vec3& color) { return 0.2126f * color.x + 0.7152f * color.y + 0.0722f * color.z; }

}  // namespace boxwood
