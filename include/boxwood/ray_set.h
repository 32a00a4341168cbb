#pragma once
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "boxwood/expected_use.h"
#include "boxwood/query.h"
#include "boxwood/ray.h"
#include "boxwood/scene.h"
#include "boxwood/structure.h"

namespace boxwood {

/// Rays of one kind that are asked one kind of question.
struct RaySet {
  std::string kind;  ///< "primary", "shadow", "ao", "diffuse1", "path", "random", "axis", "grazing", …
  Query query = Query::closest_hit;
  std::vector<Ray> rays;
};

/// What ray sets to make and from where. Same settings, same scene: same rays, on any machine and thread count.
struct RaySetSettings {
  Camera camera;
  std::uint32_t width = 512,
                height = 512;            ///< pixels of the camera; primary rays go through pixel centres in 8x8 tiles
  std::uint32_t bounces = 1;             ///< diffuse bounces: kinds diffuse1 … diffuseN
  std::uint32_t random_rays = 1u << 17;  ///< size of each set that does not come from the camera
  float ao_radius = 0;                   ///< world units; 0: a tenth of the scene's diagonal
  std::uint64_t seed = 1;
  std::uint32_t block = 1;  ///< one pixel of each block x block pixels, picked at random, starts rays; 1: all do
};

/// Every kind `make_ray_sets` knows, in its order, without bounce numbers: primary shadow ao diffuse path random axis
/// grazing.
std::span<const std::string_view> ray_kinds();

/// Makes the sets named in `kinds` (each of ray_kinds()). Secondary rays start from hits found with `structure`; since
/// every structure finds the same hits, the sets do not depend on which is used. They come in the order of ray_kinds(),
/// each once; one is empty when its rays have nowhere to start. Shadow rays go to a light of the scene, a
/// surface that gives light included, picked at random, or, in a scene without, to a place above and behind the camera.
/// Runs in the caller's TBB arena. Throws UsageError on an unknown kind or a bad setting.
std::vector<RaySet> make_ray_sets(const Scene& scene, const Structure& structure, const RaySetSettings& settings,
                                  std::span<const std::string> kinds);

/// What those who build with `rays` in mind must know of them: where each ray ends, and which triangles the rays of
/// `seen_by` end on (a full set, where `rays` is a part of it). `structure` must be of the scene that is built. Runs in
/// the caller's TBB arena. O(rays).
ExpectedUse expect_use(const Structure& structure, std::span<const RaySet> rays, std::span<const RaySet> seen_by);

/// The use that looking at the scene makes of a structure: primary, shadow, ao and diffuse rays of one pixel in each
/// block of settings.block^2; seen is what the rays of all pixels end on. Builds a structure for it. Runs in the
/// caller's TBB arena.
ExpectedUse expect_view(const Scene& scene, const RaySetSettings& settings);

/// Versioned little-endian binary file with a checksum; format in docs/ray-sets.md. Throws Error naming the file. An
/// existing file is replaced only once the new one is complete.
void save_ray_sets(const std::filesystem::path& file, std::span<const RaySet> sets);
/// Every bound is checked before memory is taken. Throws Error naming the file and what is wrong with it.
std::vector<RaySet> load_ray_sets(const std::filesystem::path& file);

}  // namespace boxwood
