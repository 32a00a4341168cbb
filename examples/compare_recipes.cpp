// Which structure for these rays? Counts the work of a few recipes on the same rays, from your own program.
// usage: example_compare_recipes [SCENE]
#include <boxwood/boxwood.h>

#include <cstdio>
#include <exception>
#include <string>
#include <vector>

int main(int argc, char** argv) try {
  const boxwood::Scene scene = boxwood::load(argc > 1 ? argv[1] : "generate:terrain(size=64)");
  const boxwood::Structure reference = boxwood::build(scene);

  boxwood::RaySetSettings settings{.camera = scene.cameras.front(), .width = 64, .height = 64};
  const std::vector<std::string> kinds{"diffuse"};
  const boxwood::RaySet rays = boxwood::make_ray_sets(scene, reference, settings, kinds).front();

  std::vector<boxwood::Hit> expected(rays.rays.size()), hits(rays.rays.size());
  std::vector<boxwood::RayCounters> counters(rays.rays.size());
  reference.closest_hits(rays.rays, expected);

  std::printf("%zu rays\n%-34s %14s %14s %10s\n", rays.rays.size(), "recipe", "node tests/ray", "triangles/ray", "SAH");
  for (const char* recipe : {"median > binary", "middle > binary", "binned > binary", "sweep(axis=all) > wide(4)"}) {
    const boxwood::Structure structure = boxwood::build(scene, recipe);
    structure.closest_hits_counted(rays.rays, hits, counters);
    if (hits != expected) throw boxwood::Error(std::string(recipe) + " finds other hits");
    double node_tests = 0, primitive_tests = 0;
    for (const boxwood::RayCounters& c : counters) node_tests += c.node_tests, primitive_tests += c.primitive_tests;
    const auto n = static_cast<double>(counters.size());
    std::printf("%-34s %14.1f %14.1f %10.1f\n", structure.recipe().text().c_str(), node_tests / n, primitive_tests / n,
                structure.report().sah_cost);
  }
  return 0;
} catch (const std::exception& error) {
  std::fprintf(stderr, "compare_recipes: %s\n", error.what());
  return 1;
}
