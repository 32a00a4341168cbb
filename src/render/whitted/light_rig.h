#pragma once
#include <span>
#include <string_view>
#include <vector>

#include "boxwood/scene.h"
#include "boxwood/structure.h"
#include "render/surface.h"

namespace boxwood {

/// Light from one place, or from one direction, without falling off with distance unless it says so.
struct RigLight {
  Vec3 position;   ///< of a light at a place
  Vec3 direction;  ///< unit, in which the light travels, of a parallel one
  bool parallel = false;
  bool fades = false;                        ///< with the square of the distance
  Vec3 normal;                               ///< zero: shines in all directions
  float full_cosine = -1, dark_cosine = -1;  ///< of a spot, as in Light; it shines along `direction`
  Vec3 intensity{1, 1, 1};                   ///< what a white diffuse surface that faces the light shows
};

/// The lights that a Whitted rendering has. An area light is a set of point lights on it, each with its share. Their
/// pictures are shown as they are, so a scene's own lights keep their proportions, but are scaled together: a white
/// surface in the middle of the scene that faced all of them would show 0.9.
struct LightRig {
  Vec3 ambient;
  std::vector<RigLight> lights;
};

/// One named arrangement of lights, placed by the camera and the size of the scene, or the scene's own.
struct LightSetting {
  std::string_view name;
  std::string_view summary;
};

/// Six settings as in the single slab study, which does not list its own (spec 003, 1.3), and `scene`.
std::span<const LightSetting> light_settings();

/// Throws UsageError naming the valid ones. A scene without lights of its own gets "point" for "scene". `structure` is
/// of the scene: lights beside the eye are kept from behind ceilings and walls.
LightRig make_light_rig(std::string_view setting, const Scene& scene, const Structure& structure,
                        const Surfaces& surfaces, const Camera& camera);

}  // namespace boxwood
