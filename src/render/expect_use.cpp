#include <tbb/parallel_sort.h>
#include <tbb/task_arena.h>

#include <algorithm>

#include "boxwood/ray_set.h"
#include "render/ray_sets.h"

namespace boxwood {

ExpectedUse expect_use(const Structure& structure, std::span<const RaySet> rays, std::span<const RaySet> seen_by) {
  ExpectedUse use;
  for (const RaySet& set : rays) {
    ExpectedRays expected{set.kind, set.query, set.rays, {}};
    for (std::size_t i = 0; const Hit& hit : trace(structure, set.rays)) {
      expected.ends.push_back(hit.valid() ? hit.t : set.rays[i].t_far);
      ++i;
    }
    use.rays.push_back(std::move(expected));
  }
  for (const RaySet& set : seen_by) {
    for (const Hit& hit : trace(structure, set.rays)) {
      if (hit.valid()) use.seen.push_back({hit.instance, hit.primitive});
    }
  }
  tbb::parallel_sort(use.seen.begin(), use.seen.end());
  use.seen.erase(std::unique(use.seen.begin(), use.seen.end()), use.seen.end());
  return use;
}

ExpectedUse expect_view(const Scene& scene, const RaySetSettings& settings) {
  const std::vector<std::string> kinds = {"primary", "shadow", "ao", "diffuse"};
  const unsigned threads = static_cast<unsigned>(tbb::this_task_arena::max_concurrency());
  const Structure structure = build(scene, "default", {.threads = threads});
  RaySetSettings all = settings;
  all.block = 1;
  ExpectedUse use = expect_use(structure, make_ray_sets(scene, structure, settings, kinds),
                               make_ray_sets(scene, structure, all, kinds));
  use.views = {{settings.camera, settings.width, settings.height}};
  return use;
}

}  // namespace boxwood
