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

namespace {

/// make(settings) makes the sets.
template <class Make>
ExpectedUse expect_sets(const Structure& structure, const RaySetSettings& settings, const Make& make) {
  RaySetSettings all = settings;
  all.block = 1;
  ExpectedUse use = expect_use(structure, make(settings), make(all));
  use.views = {{settings.camera, settings.width, settings.height}};
  return use;
}

Structure structure_to_look_with(const Scene& scene) {
  return build(scene, "default", {.threads = static_cast<unsigned>(tbb::this_task_arena::max_concurrency())});
}

const std::vector<std::string> usual_kinds = {"primary", "shadow", "ao", "diffuse"};

}  // namespace

ExpectedUse expect_view(const Scene& scene, const RaySetSettings& settings) {
  const Structure structure = structure_to_look_with(scene);
  return expect_sets(structure, settings,
                     [&](const RaySetSettings& some) { return make_ray_sets(scene, structure, some, usual_kinds); });
}

ExpectedUse expect_paths(const Scene& scene, const RaySetSettings& settings, const WholePaths& paths) {
  const Structure structure = structure_to_look_with(scene);
  return expect_sets(structure, settings, [&](const RaySetSettings& some) {
    return make_path_sets(scene, structure, some, paths, usual_kinds);
  });
}

}  // namespace boxwood
