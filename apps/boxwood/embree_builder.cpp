#include "embree_builder.h"

#ifdef BOXWOOD_EMBREE
#include <embree3/rtcore.h>
#include <fmt/format.h>
#include <tbb/global_control.h>
#include <tbb/info.h>

#include <memory>

#include "embree_calls.h"
#include "structure/mesh_geometry.h"
#include "workspace.h"

namespace boxwood::cli {
namespace {

struct Node {
  RTCBounds bounds[2];
  void* children[2];
};
struct Leaf {
  unsigned first, count;
};

void* create_node(RTCThreadLocalAllocator allocator, unsigned, void*) {
  return rtcThreadLocalAlloc(allocator, sizeof(Node), alignof(Node));
}
void set_children(void* node, void** children, unsigned count, void*) {
  for (unsigned i = 0; i < count; ++i) static_cast<Node*>(node)->children[i] = children[i];
}
void set_bounds(void* node, const RTCBounds** bounds, unsigned count, void*) {
  for (unsigned i = 0; i < count; ++i) static_cast<Node*>(node)->bounds[i] = *bounds[i];
}
void* create_leaf(RTCThreadLocalAllocator allocator, const RTCBuildPrimitive* primitives, std::size_t count, void*) {
  auto* leaf = static_cast<Leaf*>(rtcThreadLocalAlloc(allocator, sizeof(Leaf), alignof(Leaf)));
  *leaf = {primitives[0].primID, static_cast<unsigned>(count)};
  return leaf;
}

std::vector<RTCBuildPrimitive> primitives_of(const Mesh& mesh) {
  std::vector<RTCBuildPrimitive> out;
  for (const Reference& reference : MeshGeometry(mesh).references()) {
    RTCBuildPrimitive primitive = {};
    primitive.lower_x = reference.lower.x, primitive.lower_y = reference.lower.y;
    primitive.lower_z = reference.lower.z, primitive.upper_x = reference.upper.x;
    primitive.upper_y = reference.upper.y, primitive.upper_z = reference.upper.z;
    primitive.primID = reference.primitive;
    out.push_back(primitive);
  }
  return out;
}

double commit_once(const Scene& scene, RTCDevice device, RTCBuildQuality quality, unsigned threads) {
  // Or other threads work for the one whose time is taken.
  const int most = threads == 0 ? tbb::info::default_concurrency() : static_cast<int>(threads);
  const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, static_cast<std::size_t>(most));
  return EmbreeScene(device, scene.meshes.front(), quality, clock_for(threads)).build_seconds();
}

/// From triangles to a finished tree, like every other contestant.
double build_once(const Scene& scene, Clock clock) {
  const std::unique_ptr<RTCDeviceTy, decltype(&rtcReleaseDevice)> device(rtcNewDevice(nullptr), rtcReleaseDevice);
  const std::unique_ptr<RTCBVHTy, decltype(&rtcReleaseBVH)> tree(rtcNewBVH(device.get()), rtcReleaseBVH);
  const double begin = now(clock);
  std::vector<RTCBuildPrimitive> primitives = primitives_of(scene.meshes.front());
  RTCBuildArguments arguments = rtcDefaultBuildArguments();
  arguments.buildQuality = RTC_BUILD_QUALITY_MEDIUM;
  arguments.maxLeafSize = 4;
  arguments.bvh = tree.get();
  arguments.primitives = primitives.data();
  arguments.primitiveCount = primitives.size();
  arguments.primitiveArrayCapacity = primitives.size();
  arguments.createNode = create_node;
  arguments.setNodeChildren = set_children;
  arguments.setNodeBounds = set_bounds;
  arguments.createLeaf = create_leaf;
  if (!rtcBuildBVH(&arguments)) throw Error("Embree's rtcBuildBVH failed; leave --peer out");
  return now(clock) - begin;
}

}  // namespace

std::vector<NamedContestant> embree_commits(const Scene& scene, const std::vector<std::string>& qualities,
                                            unsigned threads) {
  const std::shared_ptr<RTCDeviceTy> device(
      rtcNewDevice(threads == 0 ? nullptr : fmt::format("threads={}", threads).c_str()), rtcReleaseDevice);
  std::vector<NamedContestant> out;
  for (const std::string& name : qualities) {
    const RTCBuildQuality quality = name == "low"      ? RTC_BUILD_QUALITY_LOW
                                    : name == "medium" ? RTC_BUILD_QUALITY_MEDIUM
                                                       : RTC_BUILD_QUALITY_HIGH;
    out.push_back({fmt::format("embree(quality={})", name),
                   [&scene, threads, device, quality] { return commit_once(scene, device.get(), quality, threads); }});
  }
  return out;
}

std::vector<NamedContestant> embree_builders(const Scene& scene, unsigned threads) {
  return {{"rtcBuildBVH",
           [&scene, threads] { return run_in_arena(threads, [&] { return build_once(scene, clock_for(threads)); }); }}};
}

}  // namespace boxwood::cli

#else

namespace boxwood::cli {

std::vector<NamedContestant> embree_commits(const Scene&, const std::vector<std::string>&, unsigned) { return {}; }
std::vector<NamedContestant> embree_builders(const Scene&, unsigned) { return {}; }

}  // namespace boxwood::cli

#endif
