#include "structure/object_use.h"

#include <tbb/parallel_for.h>

#include <algorithm>

#include "cost/segments.h"
#include "scene/camera_axes.h"

namespace boxwood {
namespace {

constexpr std::size_t most_rays = 4'000'000;

Window window_of(const View& view) {
  const CameraAxes axes(view.camera, view.width, view.height);
  return {view.camera.eye, axes.forward, axes.right, axes.up};
}

Window mapped(const Window& window, const Transform& map) {
  return {map.point(window.eye), map.vector(window.forward), map.vector(window.right), map.vector(window.up)};
}

Ray mapped(Ray ray, const Transform& map) {
  ray.origin = map.point(ray.origin);
  ray.direction = map.vector(ray.direction);
  return ray;
}

/// The numbers of the rays that meet a box before they end.
SegmentList rays_in(const ExpectedRays& rays, const Box& box) {
  SegmentList list;
  for (std::uint32_t i = 0; i < rays.rays.size(); ++i) {
    if (Segment(rays.rays[i], rays.ends[i]).meets(box)) list.push_back(i);
  }
  return list;
}

/// Adds the rays of one kind that reach a mesh through its instances.
void add_rays(const ExpectedRays& rays, const Scene& scene, std::span<const std::uint32_t> instances,
              std::span<const Box> boxes, std::size_t most, ExpectedRays& out) {
  std::vector<SegmentList> lists(instances.size());
  tbb::parallel_for(std::size_t{0}, instances.size(),
                    [&](std::size_t i) { lists[i] = rays_in(rays, boxes[instances[i]]); });
  std::size_t total = 0;
  for (const SegmentList& list : lists) total += list.size();
  const std::size_t step = total / most + 1;
  std::size_t number = 0;
  for (std::size_t i = 0; i < instances.size(); ++i) {
    const Transform to_object = scene.instances[instances[i]].object_to_world.inverse();
    for (const std::uint32_t ray : lists[i]) {
      if (number++ % step != 0) continue;
      out.rays.push_back(mapped(rays.rays[ray], to_object));
      out.ends.push_back(rays.ends[ray]);
    }
  }
}

}  // namespace

KnownUse use_of_mesh(const ExpectedUse& use, const Scene& scene, std::uint32_t mesh, std::span<const Box> boxes) {
  std::vector<std::uint32_t> instances;
  for (std::uint32_t i = 0; i < scene.instances.size(); ++i) {
    if (scene.instances[i].mesh == mesh) instances.push_back(i);
  }
  KnownUse known;
  known.seen.resize(scene.meshes[mesh].triangles.size());
  for (const SeenTriangle& seen : use.seen) {
    if (scene.instances[seen.instance].mesh == mesh) known.seen[seen.primitive] = 1;
  }
  const bool as_it_stands = scene.single_level();
  for (const ExpectedRays& rays : use.rays) {
    known.rays.push_back(as_it_stands ? rays : ExpectedRays{rays.kind, rays.query, {}, {}});
    if (!as_it_stands) add_rays(rays, scene, instances, boxes, most_rays / use.rays.size(), known.rays.back());
  }
  for (const View& view : use.views) {
    for (const std::uint32_t i : instances) {
      known.windows.push_back(mapped(window_of(view), scene.instances[i].object_to_world.inverse()));
    }
  }
  return known;
}

KnownUse use_of_instances(const ExpectedUse& use, const Scene& scene) {
  KnownUse known;
  known.rays = use.rays;
  known.seen.resize(scene.instances.size());
  for (const SeenTriangle& seen : use.seen) known.seen[seen.instance] = 1;
  for (const View& view : use.views) known.windows.push_back(window_of(view));
  return known;
}

}  // namespace boxwood
