// Traces the same rays with our kernels and with Embree 3, in turn, in one process and one thread. Prints million rays
// per second of the thread's CPU time and the median of the paired ratios over Embree's best call of that column.
// TRACE_BENCH_CAMERAS in the environment names a camera file; with TRACE_BENCH_AVX2 AVX-512 is left alone.
//   trace_bench SCENE ["RECIPE; RECIPE; …"] [repeats] [kinds]
#include <embree3/rtcore.h>
#include <fmt/format.h>
#include <hwy/targets.h>
#include <tbb/global_control.h>

#include <algorithm>
#include <cstdlib>
#include <functional>
#include <memory>
#include <sstream>
#include <string>
#include <string_view>
#include <vector>

#include "boxwood/ray_set.h"
#include "boxwood/scene.h"
#include "boxwood/structure.h"
#include "measure/clock.h"
#include "scene/cameras.h"
#include "structure/mesh_geometry.h"

namespace boxwood {
namespace {

enum class EmbreeCall { single, packet8, packet16, stream };

/// The scene in Embree with one build quality.
class EmbreeScene {
 public:
  EmbreeScene(RTCDevice device, const Mesh& mesh, RTCBuildQuality quality) : scene_(rtcNewScene(device)) {
    rtcSetSceneBuildQuality(scene_, quality);
    RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
    rtcSetGeometryBuildQuality(geometry, quality);
    void* positions = rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, sizeof(Vec3),
                                              mesh.positions.size());
    std::ranges::copy(mesh.positions, static_cast<Vec3*>(positions));
    void* triangles = rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, sizeof(Triangle),
                                              mesh.triangles.size());
    std::ranges::copy(mesh.triangles, static_cast<Triangle*>(triangles));
    rtcCommitGeometry(geometry);
    rtcAttachGeometry(scene_, geometry);
    rtcReleaseGeometry(geometry);
    rtcCommitScene(scene_);
  }
  ~EmbreeScene() { rtcReleaseScene(scene_); }
  EmbreeScene(const EmbreeScene&) = delete;
  EmbreeScene& operator=(const EmbreeScene&) = delete;

  void trace(const RaySet& set, EmbreeCall call, std::vector<float>& t) const {
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    context.flags = set.kind == "primary" ? RTC_INTERSECT_CONTEXT_FLAG_COHERENT : RTC_INTERSECT_CONTEXT_FLAG_INCOHERENT;
    const bool closest = set.query == Query::closest_hit;
    switch (call) {
      case EmbreeCall::single:
        return closest ? single_closest(context, set.rays, t) : single_any(context, set.rays, t);
      case EmbreeCall::packet8:
        return closest ? packets<RTCRayHit8, 8>(context, set.rays, t, rtcIntersect8)
                       : packets<RTCRay8, 8>(context, set.rays, t, rtcOccluded8);
      case EmbreeCall::packet16:
        return closest ? packets<RTCRayHit16, 16>(context, set.rays, t, rtcIntersect16)
                       : packets<RTCRay16, 16>(context, set.rays, t, rtcOccluded16);
      case EmbreeCall::stream:
        return closest ? streams<RTCRayHit>(context, set.rays, t) : streams<RTCRay>(context, set.rays, t);
    }
  }

 private:
  static RTCRay convert(const Ray& ray) {
    return {ray.origin.x,
            ray.origin.y,
            ray.origin.z,
            ray.t_near,
            ray.direction.x,
            ray.direction.y,
            ray.direction.z,
            0,
            ray.t_far,
            ~0u,
            0,
            0};
  }
  void single_closest(RTCIntersectContext& context, const std::vector<Ray>& rays, std::vector<float>& t) const {
    for (std::size_t i = 0; i < rays.size(); ++i) {
      RTCRayHit ray;
      ray.ray = convert(rays[i]);
      ray.hit.geomID = RTC_INVALID_GEOMETRY_ID;
      ray.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
      rtcIntersect1(scene_, &context, &ray);
      t[i] = ray.ray.tfar;
    }
  }
  void single_any(RTCIntersectContext& context, const std::vector<Ray>& rays, std::vector<float>& t) const {
    for (std::size_t i = 0; i < rays.size(); ++i) {
      RTCRay ray = convert(rays[i]);
      rtcOccluded1(scene_, &context, &ray);
      t[i] = ray.tfar;
    }
  }
  template <class Packet>
  static auto& ray_part(Packet& packet) {
    if constexpr (requires { packet.ray; })
      return packet.ray;
    else
      return packet;
  }
  template <class Packet, int Width, class Function>
  void packets(RTCIntersectContext& context, const std::vector<Ray>& rays, std::vector<float>& t, Function call) const {
    for (std::size_t begin = 0; begin < rays.size(); begin += Width) {
      alignas(64) Packet packet;
      alignas(64) int valid[Width];
      auto& part = ray_part(packet);
      for (std::size_t i = 0; i < Width; ++i) {
        valid[i] = begin + i < rays.size() ? -1 : 0;
        const Ray& ray = rays[std::min(begin + i, rays.size() - 1)];
        part.org_x[i] = ray.origin.x, part.org_y[i] = ray.origin.y, part.org_z[i] = ray.origin.z;
        part.dir_x[i] = ray.direction.x, part.dir_y[i] = ray.direction.y, part.dir_z[i] = ray.direction.z;
        part.tnear[i] = ray.t_near, part.tfar[i] = ray.t_far;
        part.time[i] = 0, part.mask[i] = ~0u, part.id[i] = 0, part.flags[i] = 0;
        if constexpr (requires { packet.hit; }) {
          packet.hit.geomID[i] = RTC_INVALID_GEOMETRY_ID;
          packet.hit.instID[0][i] = RTC_INVALID_GEOMETRY_ID;
        }
      }
      call(valid, scene_, &context, &packet);
      for (std::size_t i = 0; i < std::min<std::size_t>(Width, rays.size() - begin); ++i) t[begin + i] = part.tfar[i];
    }
  }
  template <class R>
  void streams(RTCIntersectContext& context, const std::vector<Ray>& rays, std::vector<float>& t) const {
    constexpr std::size_t length = 4096;
    static std::vector<R> buffer(length);
    for (std::size_t begin = 0; begin < rays.size(); begin += length) {
      const std::size_t count = std::min(length, rays.size() - begin);
      for (std::size_t i = 0; i < count; ++i) {
        ray_part(buffer[i]) = convert(rays[begin + i]);
        if constexpr (requires { buffer[i].hit; }) {
          buffer[i].hit.geomID = RTC_INVALID_GEOMETRY_ID;
          buffer[i].hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
        }
      }
      if constexpr (requires { buffer[0].hit; }) {
        rtcIntersect1M(scene_, &context, buffer.data(), static_cast<unsigned>(count), sizeof(R));
      } else {
        rtcOccluded1M(scene_, &context, buffer.data(), static_cast<unsigned>(count), sizeof(R));
      }
      for (std::size_t i = 0; i < count; ++i) t[begin + i] = ray_part(buffer[i]).tfar;
    }
  }

  RTCScene scene_;
};

struct Contestant {
  std::string name;
  bool embree;
  std::function<void(const RaySet&)> trace;
  std::vector<double> seconds;
};

double median(std::vector<double> values) {
  std::ranges::sort(values);
  return values[values.size() / 2];
}

/// Traces in turn, then prints one line per contestant.
void measure(std::vector<Contestant>& contestants, const RaySet& set, int repeats) {
  for (int repeat = -1; repeat < repeats; ++repeat) {
    for (Contestant& contestant : contestants) {
      const double begin = now(Clock::thread_cpu);
      contestant.trace(set);
      const double seconds = now(Clock::thread_cpu) - begin;
      if (repeat < 0)
        contestant.seconds.clear();
      else
        contestant.seconds.push_back(seconds);
    }
  }
  const auto best = std::ranges::min_element(contestants, {}, [](const Contestant& contestant) {
    return contestant.embree ? median(contestant.seconds) : 1e9;
  });
  for (const Contestant& contestant : contestants) {
    std::vector<double> ratios;
    for (std::size_t i = 0; i < contestant.seconds.size(); ++i) {
      ratios.push_back(best->seconds[i] / contestant.seconds[i]);
    }
    const double rays = static_cast<double>(set.rays.size());
    fmt::print("{:10} {:22} {:8.2f} Mrays/s {:7.0f} ns {:7.3f} x {}\n", set.kind, contestant.name,
               rays / median(contestant.seconds) * 1e-6, median(contestant.seconds) / rays * 1e9, median(ratios),
               best->name);
  }
  std::fflush(stdout);
}

std::vector<Contestant> embree_contestants(const std::vector<std::unique_ptr<EmbreeScene>>& scenes,
                                           std::vector<float>& t) {
  std::vector<Contestant> out;
  const char* const qualities[] = {"medium", "high"};
  for (std::size_t q = 0; q < scenes.size(); ++q) {
    for (const auto& [call, name] :
         {std::pair{EmbreeCall::single, "single"}, std::pair{EmbreeCall::packet8, "packet8"},
          std::pair{EmbreeCall::packet16, "packet16"}, std::pair{EmbreeCall::stream, "stream"}}) {
      out.push_back({fmt::format("embree.{}.{}", qualities[q], name),
                     true,
                     [&, call = call, scene = scenes[q].get()](const RaySet& set) { scene->trace(set, call, t); },
                     {}});
    }
  }
  return out;
}

void add_ours(std::vector<Contestant>& contestants, const std::string& name, const Structure& structure,
              std::vector<Hit>& hits, std::vector<std::uint8_t>& blocked) {
  contestants.push_back({name + ".single",
                         false,
                         [&](const RaySet& set) {
                           for (std::size_t i = 0; i < set.rays.size(); ++i) {
                             if (set.query == Query::closest_hit)
                               hits[i] = structure.closest_hit(set.rays[i]);
                             else
                               blocked[i] = structure.any_hit(set.rays[i]) ? 1 : 0;
                           }
                         },
                         {}});
  contestants.push_back({name + ".batch",
                         false,
                         [&](const RaySet& set) {
                           if (set.query == Query::closest_hit)
                             structure.closest_hits(set.rays, std::span(hits).first(set.rays.size()));
                           else
                             structure.any_hits(set.rays, std::span(blocked).first(set.rays.size()));
                         },
                         {}});
}

/// What the rays of a set do on average.
void print_counts(std::size_t number, const Structure& structure, const RaySet& set) {
  std::vector<RayCounters> counters(set.rays.size());
  std::vector<Hit> hits(set.rays.size());
  std::vector<std::uint8_t> blocked(set.rays.size());
  if (set.query == Query::closest_hit)
    structure.closest_hits_counted(set.rays, hits, counters);
  else
    structure.any_hits_counted(set.rays, blocked, counters);
  double steps = 0, leaves = 0, tests = 0;
  for (const RayCounters& counter : counters) {
    steps += counter.steps, leaves += counter.leaves, tests += counter.primitive_tests;
  }
  const auto rays = static_cast<double>(set.rays.size());
  fmt::print("{:10} [{}] {:.2f} steps, {:.2f} leaves, {:.2f} triangles per ray\n", set.kind, number, steps / rays,
             leaves / rays, tests / rays);
}

int run(int argc, char** argv) {
  if (std::getenv("TRACE_BENCH_AVX2")) hwy::DisableTargets(HWY_AVX3 | (HWY_AVX3 - 1));
  const std::string file = argc > 1 ? argv[1] : "generate:random";
  const std::string recipes = argc > 2 ? argv[2] : "default";
  const int repeats = argc > 3 ? std::stoi(argv[3]) : 5;
  Scene scene = flatten(load(file));
  if (const char* cameras = std::getenv("TRACE_BENCH_CAMERAS")) scene.cameras = read_cameras(cameras);
  const Mesh& mesh = scene.meshes.front();
  std::vector<Structure> structures;
  std::istringstream each(recipes);
  for (std::string recipe; std::getline(each, recipe, ';');) structures.push_back(build(scene, recipe));

  RaySetSettings settings;
  settings.camera = scene.cameras.front();
  settings.width = settings.height = 1024;
  settings.random_rays = 1u << 18;
  std::vector<std::string> kinds = {"primary", "diffuse", "random", "ao", "shadow"};
  if (argc > 4) kinds.assign(argv + 4, argv + argc);
  std::vector<RaySet> sets = make_ray_sets(scene, structures.front(), settings, kinds);
  std::size_t longest = 0;
  for (RaySet& set : sets) {
    if (set.kind != "primary" && set.rays.size() > settings.random_rays) set.rays.resize(settings.random_rays);
    longest = std::max(longest, set.rays.size());
  }

  const tbb::global_control one_thread(tbb::global_control::max_allowed_parallelism, 1);
  std::vector<Hit> hits(longest);
  std::vector<std::uint8_t> blocked(longest);
  std::vector<float> t(longest);
  RTCDevice device = rtcNewDevice("threads=1");
  std::vector<std::unique_ptr<EmbreeScene>> embree;
  embree.push_back(std::make_unique<EmbreeScene>(device, mesh, RTC_BUILD_QUALITY_MEDIUM));
  embree.push_back(std::make_unique<EmbreeScene>(device, mesh, RTC_BUILD_QUALITY_HIGH));

  for (std::size_t i = 0; i < structures.size(); ++i) {
    fmt::print("[{}] {}: {} triangles, {}, {:.1f} bytes per triangle\n", i, file, mesh.triangles.size(),
               structures[i].recipe().text(),
               static_cast<double>(structures[i].report().bytes) / static_cast<double>(mesh.triangles.size()));
  }
  for (const RaySet& set : sets) {
    std::vector<Contestant> contestants = embree_contestants(embree, t);
    for (std::size_t i = 0; i < structures.size(); ++i) {
      add_ours(contestants, fmt::format("[{}]", i), structures[i], hits, blocked);
      print_counts(i, structures[i], set);
    }
    measure(contestants, set, repeats);
  }
  embree.clear();
  rtcReleaseDevice(device);
  return 0;
}

}  // namespace
}  // namespace boxwood

int main(int argc, char** argv) { return boxwood::run(argc, argv); }
