#include "boxwood/ray_set.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>

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

void append(std::vector<Ray>& all, const std::vector<Ray>& more) { all.insert(all.end(), more.begin(), more.end()); }

/// The sets that start at the camera, those that are wanted: bounce by bounce, as a renderer would come to them.
template <class Wanted>
void add_camera_sets(const RaySetContext& context, const Wanted& wanted, std::vector<RaySet>& sets) {
  const RaySetSettings& settings = context.settings;
  const bool lit = wanted("shadow") || wanted("ao");
  if (!wanted("primary") && !lit && !wanted("diffuse")) return;
  const std::uint32_t bounces = wanted("diffuse") || (lit && context.whole) ? settings.bounces : 0;
  RaySet shadow{"shadow", Query::any_hit, {}}, ao{"ao", Query::any_hit, {}};
  std::vector<RaySet> diffuse;
  std::vector<Ray> rays = primary_rays(context);
  if (wanted("primary")) sets.push_back({"primary", Query::closest_hit, rays});
  for (std::uint32_t depth = 0;; ++depth) {
    const bool light_here = lit && (depth == 0 || context.whole);
    if (!light_here && depth == bounces) break;
    const std::vector<Hit> hits = trace(context.structure, rays);
    if (light_here && wanted("shadow")) append(shadow.rays, shadow_rays(context, rays, hits, depth));
    if (light_here && wanted("ao")) append(ao.rays, ao_rays(context, rays, hits, depth));
    if (depth == bounces) break;
    rays = diffuse_rays(context, rays, hits, depth + 1);
    if (wanted("diffuse")) diffuse.push_back({fmt::format("diffuse{}", depth + 1), Query::closest_hit, rays});
  }
  if (wanted("shadow")) sets.push_back(std::move(shadow));
  if (wanted("ao")) sets.push_back(std::move(ao));
  std::ranges::move(diffuse, std::back_inserter(sets));
}

std::vector<RaySet> make_sets(const Scene& scene, const Structure& structure, const RaySetSettings& asked,
                              const WholePaths* whole, std::span<const std::string> kinds) {
  check(asked, kinds);
  RaySetSettings settings = asked;
  const Surfaces surfaces(scene);
  const RaySetContext context{scene, structure, settings, surfaces, scene.bounds(), whole};
  if (settings.ao_radius == 0) settings.ao_radius = default_ao_radius(context.bounds);

  const auto wanted = [&](std::string_view kind) { return std::ranges::find(kinds, kind) != kinds.end(); };
  std::vector<RaySet> sets;
  add_camera_sets(context, wanted, sets);
  if (wanted("path")) sets.push_back({"path", Query::closest_hit, path_rays(context)});
  if (wanted("random")) sets.push_back({"random", Query::closest_hit, random_rays(context)});
  if (wanted("axis")) sets.push_back({"axis", Query::closest_hit, axis_rays(context)});
  if (wanted("grazing")) sets.push_back({"grazing", Query::closest_hit, grazing_rays(context)});
  return sets;
}

}  // namespace

void keep_spread_runs(std::vector<Ray>& rays, std::size_t run, std::size_t most) {
  const std::size_t runs = rays.size() / run, kept = std::max<std::size_t>(most / run, 1);
  if (runs <= kept) return;
  for (std::size_t i = 0; i < kept; ++i) {
    const std::size_t from = i * runs / kept;  // never before i
    if (from == i) continue;
    std::copy_n(rays.begin() + static_cast<std::ptrdiff_t>(from * run), run,
                rays.begin() + static_cast<std::ptrdiff_t>(i * run));
  }
  rays.resize(kept * run);
}

std::span<const std::string_view> ray_kinds() { return kinds_in_order; }

std::vector<RaySet> make_ray_sets(const Scene& scene, const Structure& structure, const RaySetSettings& settings,
                                  std::span<const std::string> kinds) {
  return make_sets(scene, structure, settings, nullptr, kinds);
}

std::vector<RaySet> make_path_sets(const Scene& scene, const Structure& structure, const RaySetSettings& settings,
                                   const WholePaths& paths, std::span<const std::string> kinds) {
  if (paths.ao_rays == 0) throw UsageError("ambient occlusion needs at least 1 ray from each point");
  return make_sets(scene, structure, settings, &paths, kinds);
}

}  // namespace boxwood
