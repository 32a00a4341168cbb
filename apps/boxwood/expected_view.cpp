#include "expected_view.h"

#include <algorithm>
#include <string>

#include "boxwood/structure.h"
#include "workspace.h"

namespace boxwood::cli {
namespace {

bool any_needs_use(std::span<const Recipe> recipes) { return std::ranges::any_of(recipes, needs_use); }

View view_of(const Scene& scene, const ViewOptions& view) {
  return {find_camera(scene, view), view.width, view.height};
}

/// Every step-th ray, in place of all.
RaySet thinned(const RaySet& set, std::size_t step) {
  RaySet thin{set.kind, set.query, {}};
  for (std::size_t i = 0; i < set.rays.size(); i += step) thin.rays.push_back(set.rays[i]);
  return thin;
}

}  // namespace

std::optional<ExpectedUse> expected_view(const Scene& scene, std::span<const Recipe> recipes, const ViewOptions& view,
                                         unsigned threads) {
  if (!any_needs_use(recipes)) return {};
  return expected_view(scene, view, threads);
}

ExpectedUse expected_view(const Scene& scene, const ViewOptions& view, unsigned threads) {
  return expected_view(scene, find_camera(scene, view), view, threads);
}

ExpectedUse expected_view(const Scene& scene, const Camera& camera, const ViewOptions& view, unsigned threads) {
  RaySetSettings settings;
  settings.camera = camera;
  settings.width = view.width;
  settings.height = view.height;
  settings.block = view.block;
  return run_in_arena(threads, [&] { return expect_view(scene, settings); });
}

ExpectedUse expected_rays(const Scene& scene, std::span<const RaySet> ray_sets, const ViewOptions& view,
                          unsigned threads) {
  std::vector<RaySet> some;
  for (const RaySet& set : ray_sets) some.push_back(thinned(set, std::size_t{view.block} * view.block));
  const Structure structure = build(scene, "default", {.threads = threads});
  ExpectedUse use = run_in_arena(threads, [&] { return expect_use(structure, some, ray_sets); });
  use.views = {view_of(scene, view)};
  return use;
}

}  // namespace boxwood::cli
