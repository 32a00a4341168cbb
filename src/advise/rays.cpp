// Rays for scenes whose use is not known.
#include <algorithm>

#include "advise/advise.h"
#include "advise/free_cameras.h"
#include "boxwood/structure.h"
#include "scene/cameras.h"

namespace boxwood {
namespace {

constexpr std::uint32_t views = 4;

}  // namespace

std::vector<RaySet> rays_to_advise_for(const Scene& scene, std::span<const std::string> kinds, std::uint32_t size,
                                       unsigned threads, std::vector<Camera>& cameras) {
  const Structure structure = build(scene, "default", {.threads = threads});
  cameras = free_cameras(scene, structure, views - 1);
  if (!scene.cameras.empty()) cameras.insert(cameras.begin(), scene.cameras.front());
  for (const Camera& camera : orbit_path(scene.bounds(), views)) {
    if (cameras.size() < views) cameras.push_back(camera);
  }
  std::vector<RaySet> all;
  for (const Camera& camera : cameras) {
    RaySetSettings settings;
    settings.camera = camera;
    settings.width = settings.height = size;
    settings.random_rays = size * size;
    for (RaySet& set : make_ray_sets(scene, structure, settings, kinds)) {
      const auto same = std::ranges::find(all, set.kind, &RaySet::kind);
      if (same == all.end()) {
        all.push_back(std::move(set));
      } else {
        same->rays.insert(same->rays.end(), set.rays.begin(), set.rays.end());
      }
    }
  }
  return all;
}

}  // namespace boxwood
