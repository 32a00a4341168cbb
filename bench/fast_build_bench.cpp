// Builds the same triangles with our builders and with Embree 3's, in turn and in one process, from triangles to a
// structure that can be traced. Prints nanoseconds per triangle, median and quickest, the median of the paired ratios
// to each Embree quality, bytes per triangle and the trees' surface area cost. On one thread a second is the thread's
// CPU time, on more the wall's.
//   fast_build_bench REPEATS SCENE… [-t THREADS] [-a RECIPE]…
#include <embree3/rtcore.h>
#include <fmt/format.h>
#include <tbb/global_control.h>

#include <algorithm>
#include <atomic>
#include <string>
#include <vector>

#include "boxwood/scene.h"
#include "measure/clock.h"
#include "measure/interleave.h"
#include "measure/statistics.h"
#include "structure/mesh_geometry.h"
#include "structure/pipeline.h"
#include "tree/statistics.h"

namespace boxwood {
namespace {

/// What was measured of one contestant, beside its seconds.
struct Made {
  double bytes_per_triangle = 0, sah = 0;
};

bool count_bytes(void* counter, ssize_t bytes, bool) {
  static_cast<std::atomic<std::ptrdiff_t>*>(counter)->fetch_add(bytes);
  return true;
}

class EmbreeBuilds {
 public:
  EmbreeBuilds(const Mesh& mesh, int threads, Clock clock)
      : device_(rtcNewDevice(fmt::format("threads={}", threads).c_str())), mesh_(mesh), clock_(clock) {
    rtcSetDeviceMemoryMonitorFunction(device_, count_bytes, &bytes_);
  }
  ~EmbreeBuilds() { rtcReleaseDevice(device_); }
  EmbreeBuilds(const EmbreeBuilds&) = delete;
  EmbreeBuilds& operator=(const EmbreeBuilds&) = delete;

  double seconds(RTCBuildQuality quality, Made& made) {
    RTCScene scene = rtcNewScene(device_);
    rtcSetSceneBuildQuality(scene, quality);
    RTCGeometry geometry = rtcNewGeometry(device_, RTC_GEOMETRY_TYPE_TRIANGLE);
    rtcSetGeometryBuildQuality(geometry, quality);
    const auto buffer = [&](RTCBufferType type, RTCFormat format, const auto& items) {
      using Item = std::decay_t<decltype(items.front())>;
      void* out = rtcSetNewGeometryBuffer(geometry, type, 0, format, sizeof(Item), items.size());
      std::ranges::copy(items, static_cast<Item*>(out));
    };
    buffer(RTC_BUFFER_TYPE_VERTEX, RTC_FORMAT_FLOAT3, mesh_.positions);
    buffer(RTC_BUFFER_TYPE_INDEX, RTC_FORMAT_UINT3, mesh_.triangles);
    rtcCommitGeometry(geometry);
    rtcAttachGeometry(scene, geometry);
    rtcReleaseGeometry(geometry);
    const std::ptrdiff_t before = bytes_;
    const double begin = now(clock_);
    rtcCommitScene(scene);
    const double seconds = now(clock_) - begin;
    made.bytes_per_triangle = static_cast<double>(bytes_ - before) / static_cast<double>(mesh_.triangles.size());
    rtcReleaseScene(scene);
    return seconds;
  }

 private:
  std::atomic<std::ptrdiff_t> bytes_ = 0;
  RTCDevice device_;
  const Mesh& mesh_;
  Clock clock_;
};

double our_seconds(const Mesh& mesh, const Recipe& recipe, Clock clock, Made& made) {
  Contents contents;
  contents.mesh = &mesh;
  const double begin = now(clock);
  const Pipeline pipeline(recipe);
  const MeshGeometry geometry(mesh);
  Tree tree = pipeline.tree({geometry.references(), &geometry});
  const double tree_end = now(clock);
  made.sah = sah_cost(tree);
  const double layout_begin = now(clock);
  const auto layout = pipeline.encode(std::move(tree), contents);
  const double seconds = tree_end - begin + now(clock) - layout_begin;
  made.bytes_per_triangle = static_cast<double>(layout->bytes()) / static_cast<double>(mesh.triangles.size());
  return seconds;
}

void run(const std::string& path, const std::vector<std::string>& recipes, std::uint32_t repeats, int threads) {
  const Clock clock = threads == 1 ? Clock::thread_cpu : Clock::wall;
  const Scene scene = flatten(load(path));
  const Mesh& mesh = scene.meshes.front();
  EmbreeBuilds embree(mesh, threads, clock);
  const std::vector<RTCBuildQuality> qualities = {RTC_BUILD_QUALITY_LOW, RTC_BUILD_QUALITY_MEDIUM,
                                                  RTC_BUILD_QUALITY_HIGH};
  std::vector<std::string> names = {"embree LOW", "embree MEDIUM", "embree HIGH"};
  names.insert(names.end(), recipes.begin(), recipes.end());
  std::vector<Made> made(names.size());
  std::vector<Contestant> contestants;
  for (std::size_t c = 0; c < names.size(); ++c) {
    if (c < qualities.size()) {
      contestants.emplace_back([&, c] { return embree.seconds(qualities[c], made[c]); });
    } else {
      contestants.emplace_back(
          [&, c, recipe = Recipe::parse(names[c])] { return our_seconds(mesh, recipe, clock, made[c]); });
    }
  }
  const auto seconds = interleave(contestants, {repeats, 1});

  fmt::print("{}: {} triangles, {} threads\n{:60} {:>8} {:>8} {:>7} {:>7} {:>7} {:>7} {:>7}\n", path,
             mesh.triangles.size(), threads, "", "ns/tri", "quickest", "/LOW", "/MEDIUM", "/HIGH", "B/tri", "sah");
  for (std::size_t c = 0; c < contestants.size(); ++c) {
    const double per_triangle = 1e9 / static_cast<double>(mesh.triangles.size());
    fmt::print("{:60} {:8.1f} {:8.1f}", names[c], median(seconds[c]) * per_triangle,
               *std::ranges::min_element(seconds[c]) * per_triangle);
    for (std::size_t q = 0; q < qualities.size(); ++q) {
      fmt::print(" {:7.2f}", estimate_ratio(seconds[c], seconds[q]).median);
    }
    fmt::print(" {:7.1f} {:>7}\n", made[c].bytes_per_triangle,
               c < qualities.size() ? "" : fmt::format("{:.2f}", made[c].sah));
  }
}

}  // namespace
}  // namespace boxwood

int main(int argc, char** argv) {
  std::vector<std::string> scenes, recipes;
  int threads = 1;
  for (int i = 2; i < argc; ++i) {
    const std::string argument = argv[i];
    if (argument == "-t" && i + 1 < argc) {
      threads = std::stoi(argv[++i]);
    } else if (argument == "-a" && i + 1 < argc) {
      recipes.emplace_back(argv[++i]);
    } else {
      scenes.push_back(argument);
    }
  }
  const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, static_cast<std::size_t>(threads));
  if (scenes.empty()) {
    fmt::print(stderr, "fast_build_bench REPEATS SCENE… [-t THREADS] [-a RECIPE]…\n");
    return 2;
  }
  if (recipes.empty()) {
    recipes = {"fast", "default", "best"};
  }
  try {
    for (const std::string& scene : scenes) {
      boxwood::run(scene, recipes, static_cast<std::uint32_t>(std::stoul(argv[1])), threads);
    }
  } catch (const std::exception& error) {
    fmt::print(stderr, "{}\n", error.what());
    return 1;
  }
}
