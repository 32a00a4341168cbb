#include "boxwood/ray_set.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "options/suggest.h"
#include "render/ray_sets.h"
#include "render/secondary_rays.h"

namespace boxwood {
namespace {

constexpr std::array<std::string_view, 8> kinds_in_order = {"primary", "shadow", "ao",   "diffuse",
                                                            "path",    "random", "axis", "grazing"};

void check(const RaySetSettings& settings, std::span<const std::string> kinds) {
  for (const std::string& kind : kinds) {
    if (std::ranges::find(kinds_in_order, kind) != kinds_in_order.end()) continue;
    const std::vector<std::string> names(kinds_in_order.begin(), kinds_in_order.end());
    throw UsageError(fmt::format("unknown kind of rays '{}': {}", kind, suggest(kind, names)));
  }
  if (settings.bounces == 0 && std::ranges::find(kinds, "diffuse") != kinds.end()) {
    throw UsageError("diffuse rays need at least 1 bounce");
  }
  if (settings.block == 0) throw UsageError("a block of pixels is at least 1 wide");
  if (!(settings.ao_radius >= 0 && std::isfinite(settings.ao_radius))) {
    throw UsageError(fmt::format("ao_radius must be 0 or more, not {}", settings.ao_radius));
  }
}

}  // namespace

std::span<const std::string_view> ray_kinds() { return kinds_in_order; }

std::vector<RaySet> make_ray_sets(const Scene& scene, const Structure& structure, const RaySetSettings& asked,
                                  std::span<const std::string> kinds) {
  check(asked, kinds);
  RaySetSettings settings = asked;
  const Surfaces surfaces(scene);
  const RaySetContext context{scene, structure, settings, surfaces, scene.bounds()};
  if (settings.ao_radius == 0) settings.ao_radius = default_ao_radius(context.bounds);

  const auto wanted = [&](std::string_view kind) { return std::ranges::find(kinds, kind) != kinds.end(); };
  const bool from_hits = wanted("shadow") || wanted("ao") || wanted("diffuse");
  std::vector<Ray> rays;
  std::vector<Hit> hits;
  if (wanted("primary") || from_hits) rays = primary_rays(context);
  if (from_hits) hits = trace(structure, rays);

  std::vector<RaySet> sets;
  if (wanted("primary")) sets.push_back({"primary", Query::closest_hit, rays});
  if (wanted("shadow")) sets.push_back({"shadow", Query::any_hit, shadow_rays(context, rays, hits)});
  if (wanted("ao")) sets.push_back({"ao", Query::any_hit, ao_rays(context, rays, hits)});
  if (wanted("diffuse")) {
    for (std::uint32_t bounce = 1; bounce <= settings.bounces; ++bounce) {
      rays = diffuse_rays(context, rays, hits, bounce);
      sets.push_back({fmt::format("diffuse{}", bounce), Query::closest_hit, rays});
      if (bounce < settings.bounces) hits = trace(structure, rays);
    }
  }
  if (wanted("path")) sets.push_back({"path", Query::closest_hit, path_rays(context)});
  if (wanted("random")) sets.push_back({"random", Query::closest_hit, random_rays(context)});
  if (wanted("axis")) sets.push_back({"axis", Query::closest_hit, axis_rays(context)});
  if (wanted("grazing")) sets.push_back({"grazing", Query::closest_hit, grazing_rays(context)});
  return sets;
}

}  // namespace boxwood
