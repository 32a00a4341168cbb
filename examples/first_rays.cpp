// The shortest useful program: load a mesh, build a structure, ask it for rays.
// usage: example_first_rays [SCENE [RECIPE]]
#include <boxwood/boxwood.h>

#include <cstdio>
#include <exception>
#include <vector>

int main(int argc, char** argv) try {
  const boxwood::Scene scene = boxwood::load(argc > 1 ? argv[1] : "generate:sphere");
  const boxwood::Structure bvh = boxwood::build(scene, argc > 2 ? argv[2] : "default");

  // One ray: from outside the scene towards its middle.
  const boxwood::Box bounds = scene.bounds();
  const boxwood::Vec3 eye = bounds.upper + bounds.extent();
  const boxwood::Ray ray{.origin = eye, .direction = bounds.center() - eye};
  const boxwood::Hit hit = bvh.closest_hit(ray);
  if (hit.valid()) {
    std::printf("triangle %u of instance %u at t = %g\n", hit.primitive, hit.instance, static_cast<double>(hit.t));
  } else {
    std::printf("nothing is hit\n");
  }

  // Many rays: one call for all of them is the fast path.
  std::vector<boxwood::Ray> rays(10'000, ray);
  for (std::size_t i = 0; i < rays.size(); ++i) rays[i].origin.x += 1e-4f * static_cast<float>(i) * bounds.extent().x;
  std::vector<boxwood::Hit> hits(rays.size());
  bvh.closest_hits(rays, hits);
  std::size_t count = 0;
  for (const boxwood::Hit& h : hits) count += h.valid() ? 1 : 0;
  std::printf("%zu of %zu rays hit; built in %.1f ms, %.1f bytes per triangle\n", count, rays.size(),
              bvh.report().build_ms,
              static_cast<double>(bvh.report().bytes) / static_cast<double>(bvh.report().primitives));
  return 0;
} catch (const std::exception& error) {
  std::fprintf(stderr, "first_rays: %s\n", error.what());
  return 1;
}
