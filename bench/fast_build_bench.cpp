// Builds the same triangles with our builders and with Embree 3's, in turn, in one process and on one thread. Prints
// nanoseconds of CPU time per triangle, the median of the paired ratios to each Embree quality, and the trees' surface
// area cost. Ours end with the tree, Embree's with a structure that can be traced.
//   fast_build_bench REPEATS SCENE… [-a RECIPE]…
#include <embree3/rtcore.h>
#include <fmt/format.h>
#include <tbb/global_control.h>

#include <algorithm>
#include <string>
#include <vector>

#include "boxwood/scene.h"
#include "measure/clock.h"
#include "measure/interleave.h"
#include "measure/statistics.h"
#include "structure/pipeline.h"
#include "tree/statistics.h"

namespace boxwood {
namespace {

double embree_seconds(RTCDevice device, const Mesh& mesh, RTCBuildQuality quality) {
  RTCScene scene = rtcNewScene(device);
  rtcSetSceneBuildQuality(scene, quality);
  RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
  rtcSetGeometryBuildQuality(geometry, quality);
  const auto buffer = [&](RTCBufferType type, RTCFormat format, const auto& items) {
    using Item = std::decay_t<decltype(items.front())>;
    void* out = rtcSetNewGeometryBuffer(geometry, type, 0, format, sizeof(Item), items.size());
    std::ranges::copy(items, static_cast<Item*>(out));
  };
  buffer(RTC_BUFFER_TYPE_VERTEX, RTC_FORMAT_FLOAT3, mesh.positions);
  buffer(RTC_BUFFER_TYPE_INDEX, RTC_FORMAT_UINT3, mesh.triangles);
  rtcCommitGeometry(geometry);
  rtcAttachGeometry(scene, geometry);
  rtcReleaseGeometry(geometry);
  const double begin = now(Clock::thread_cpu);
  rtcCommitScene(scene);
  const double seconds = now(Clock::thread_cpu) - begin;
  rtcReleaseScene(scene);
  return seconds;
}

void run(const std::string& path, const std::vector<std::string>& recipes, std::uint32_t repeats) {
  const Scene scene = flatten(load(path));
  const Mesh& mesh = scene.meshes.front();
  const auto device = rtcNewDevice("threads=1");
  struct Quality {
    const char* name;
    RTCBuildQuality value;
  };
  const std::vector<Quality> qualities = {{"embree LOW", RTC_BUILD_QUALITY_LOW},
                                          {"embree MEDIUM", RTC_BUILD_QUALITY_MEDIUM},
                                          {"embree HIGH", RTC_BUILD_QUALITY_HIGH}};
  std::vector<Contestant> contestants;
  for (const Quality& quality : qualities) {
    contestants.emplace_back([&, quality] { return embree_seconds(device, mesh, quality.value); });
  }
  std::vector<double> sah(recipes.size());
  std::vector<Recipe> parsed;
  for (const std::string& recipe : recipes) parsed.push_back(Recipe::parse(recipe));
  for (std::size_t r = 0; r < parsed.size(); ++r) {
    contestants.emplace_back([&, r] {
      const double begin = now(Clock::thread_cpu);
      const Tree tree = tree_of(mesh, parsed[r]);
      const double seconds = now(Clock::thread_cpu) - begin;
      sah[r] = sah_cost(tree);
      return seconds;
    });
  }
  const auto seconds = interleave(contestants, {repeats, 1});
  rtcReleaseDevice(device);

  const auto triangles = static_cast<double>(mesh.triangles.size());
  fmt::print("{}: {} triangles\n{:60} {:>8} {:>8} {:>7} {:>7} {:>7}\n", path, mesh.triangles.size(), "", "ns/tri",
             "sah", "/LOW", "/MEDIUM", "/HIGH");
  for (std::size_t c = 0; c < contestants.size(); ++c) {
    const bool ours = c >= qualities.size();
    fmt::print("{:60} {:8.1f} {:>8}", ours ? recipes[c - qualities.size()] : qualities[c].name,
               median(seconds[c]) / triangles * 1e9, ours ? fmt::format("{:.2f}", sah[c - qualities.size()]) : "");
    for (std::size_t q = 0; q < qualities.size(); ++q) {
      fmt::print(" {:7.2f}", estimate_ratio(seconds[c], seconds[q]).median);
    }
    fmt::print("\n");
  }
}

}  // namespace
}  // namespace boxwood

int main(int argc, char** argv) {
  const tbb::global_control one_thread(tbb::global_control::max_allowed_parallelism, 1);
  std::vector<std::string> scenes, recipes;
  for (int i = 2; i < argc; ++i) {
    const bool recipe = std::string(argv[i]) == "-a" && i + 1 < argc;
    (recipe ? recipes : scenes).emplace_back(argv[recipe ? ++i : i]);
  }
  if (scenes.empty()) {
    fmt::print(stderr, "fast_build_bench REPEATS SCENE… [-a RECIPE]…\n");
    return 2;
  }
  if (recipes.empty()) {
    recipes = {"ploc > collapse(8) > wide(8)", "ploc > reinsert > collapse(8) > wide(8)",
               "binned > collapse(8) > wide(8)", "spatial > reinsert > optimal-collapse(8) > wide(8)"};
  }
  try {
    for (const std::string& scene : scenes)
      boxwood::run(scene, recipes, static_cast<std::uint32_t>(std::stoul(argv[1])));
  } catch (const std::exception& error) {
    fmt::print(stderr, "{}\n", error.what());
    return 1;
  }
}
