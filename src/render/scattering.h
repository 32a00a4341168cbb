#pragma once
#include <array>
#include <cstdint>
#include <string_view>

#include "boxwood/vec3.h"
#include "math/random.h"
#include "render/surface.h"

namespace boxwood {

/// Ways in which a surface scatters light. The first two spread it and can be lit directly; the others send it one way.
enum class Lobe : std::uint8_t { diffuse, glossy, reflection, refraction };
inline constexpr std::size_t lobe_count = 4;
constexpr bool spreads(Lobe lobe) { return lobe <= Lobe::glossy; }

/// A direction in which a path goes on.
struct ScatteredRay {
  Vec3 direction;  ///< unit
  /// Factor for the light that comes from there; zero ends the path. Its mean over all samples is at most 1.
  Vec3 weight;
  float density = 0;  ///< per solid angle, over both spreading lobes; 0 for the others
  Lobe lobe = Lobe::diffuse;
};

/// How the material of one point scatters light towards the viewer, on the side that is seen: Lambert, Phong's lobe as
/// normalised by Lafortune and Willems (1994), a mirror, and smooth glass by Fresnel and Snell. Gives back at most the
/// light that arrives. The scaling of radiance by the square of the refraction index is left out: it cancels for light
/// that leaves again.
class Scattering {
 public:
  /// `incoming` is the unit direction in which the point is seen.
  Scattering(const SurfacePoint& point, const Vec3& incoming);

  /// Whether light sampled at its source can reach the viewer.
  bool spreads_light() const;
  /// Share of the radiance from the unit direction `to_light` that leaves towards the viewer, per solid angle, cosine
  /// included; spreading lobes only.
  Vec3 evaluate(const Vec3& to_light) const;
  /// Density of sample() for that direction; spreading lobes only.
  float density(const Vec3& to_light) const;
  ScatteredRay sample(Random& random) const;
  /// Unit normal on the side that is seen.
  const Vec3& normal() const { return normal_; }

 private:
  Lobe pick(Random& random) const;
  Vec3 mirror_direction() const;
  Vec3 spread_direction(Lobe lobe, Random& random) const;

  Vec3 incoming_, normal_;
  float shininess_ = 0;
  float index_ = 1;                            // of this side relative to the other
  std::array<Vec3, lobe_count> share_;         // of the light that arrives
  std::array<float, lobe_count> probability_;  // of picking a lobe; all 0 on a black surface
};

/// Share of light that a smooth boundary reflects, averaged over both polarisations (Fresnel). `cosine` in [0, 1] is
/// that of the angle to the normal on this side, `index` the refraction index of this side relative to the other. 1
/// from the angle of total reflection on.
float fresnel_reflectance(float cosine, float index);

}  // namespace boxwood
