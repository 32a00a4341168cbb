#ifdef BOXWOOD_EMBREE
#include "layout/embree/embree_scene.h"

#include <fmt/format.h>
#include <tbb/info.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <cmath>

#include "boxwood/error.h"

namespace boxwood {
namespace {

bool count_bytes(void* counter, ssize_t bytes, bool) {
  static_cast<std::atomic<std::ptrdiff_t>*>(counter)->fetch_add(bytes);
  return true;
}

RTCBuildQuality quality_of(EmbreeQuality quality) {
  switch (quality) {
    case EmbreeQuality::low:
      return RTC_BUILD_QUALITY_LOW;
    case EmbreeQuality::medium:
      break;
    case EmbreeQuality::high:
      return RTC_BUILD_QUALITY_HIGH;
  }
  return RTC_BUILD_QUALITY_MEDIUM;
}

std::vector<std::uint32_t> usable_numbers(const Mesh& mesh) {
  std::vector<std::uint32_t> numbers;
  for (std::uint32_t i = 0; i < mesh.triangles.size(); ++i) {
    if (is_usable(mesh, i)) numbers.push_back(i);
  }
  return numbers;
}

}  // namespace

EmbreeScene::EmbreeScene(const Scene& scene, const EmbreeOptions& options) {
  // Embree has its own arena, so the caller's limit must be told to it. It then limits the whole process while the
  // device lives; without a limit it must not be told anything.
  const int threads = tbb::this_task_arena::max_concurrency();
  const bool limited = threads < tbb::info::default_concurrency();
  device_ = rtcNewDevice(limited ? fmt::format("threads={}", threads).c_str() : nullptr);
  if (!device_) throw Error("Embree cannot start on this machine; use one of Boxwood's own layouts");
  try {
    rtcSetDeviceMemoryMonitorFunction(device_, count_bytes, &bytes_);
    numbers_.resize(scene.meshes.size());
    for (const Instance& instance : scene.instances) mesh_of_.push_back(instance.mesh);
    for (std::size_t m = 0; m < scene.meshes.size(); ++m) {
      bottoms_.push_back(commit_mesh(scene.meshes[m], options, numbers_[m]));
    }
    if (scene.single_level()) {
      top_ = bottoms_[0];
      rtcRetainScene(top_);
      return;
    }
    top_ = new_scene(options);
    for (std::uint32_t i = 0; i < scene.instances.size(); ++i) {
      const RTCGeometry geometry = rtcNewGeometry(device_, RTC_GEOMETRY_TYPE_INSTANCE);
      rtcSetGeometryInstancedScene(geometry, bottoms_[scene.instances[i].mesh]);
      rtcSetGeometryTransform(geometry, 0, RTC_FORMAT_FLOAT3X4_COLUMN_MAJOR, &scene.instances[i].object_to_world);
      rtcCommitGeometry(geometry);
      rtcAttachGeometryByID(top_, geometry, i);
      rtcReleaseGeometry(geometry);
    }
    rtcCommitScene(top_);
    check();
  } catch (...) {
    release();
    throw;
  }
}

EmbreeScene::~EmbreeScene() { release(); }

void EmbreeScene::release() {
  if (top_) rtcReleaseScene(top_);
  for (const RTCScene bottom : bottoms_) rtcReleaseScene(bottom);
  rtcReleaseDevice(device_);
}

RTCScene EmbreeScene::new_scene(const EmbreeOptions& options) {
  const RTCScene scene = rtcNewScene(device_);
  rtcSetSceneBuildQuality(scene, quality_of(options.quality));
  rtcSetSceneFlags(scene, static_cast<RTCSceneFlags>((options.robust ? RTC_SCENE_FLAG_ROBUST : RTC_SCENE_FLAG_NONE) |
                                                     (options.compact ? RTC_SCENE_FLAG_COMPACT : RTC_SCENE_FLAG_NONE)));
  return scene;
}

RTCScene EmbreeScene::commit_user_mesh(const Mesh& mesh, const EmbreeOptions& options) {
  user_meshes_.push_back(std::make_unique<EmbreeUserMesh>());
  EmbreeUserMesh& user = *user_meshes_.back();
  for (const std::uint32_t i : usable_numbers(mesh)) {
    const auto& [a, b, c] = mesh.triangles[i];
    user.triangles.push_back({mesh.positions[a], mesh.positions[b], mesh.positions[c], i});
    for (const Vec3& corner : {mesh.positions[a], mesh.positions[b], mesh.positions[c]}) {
      user.reach = std::max({user.reach, std::fabs(corner.x), std::fabs(corner.y), std::fabs(corner.z)});
    }
  }
  bytes_ += static_cast<std::ptrdiff_t>(user.triangles.size() * sizeof(LeafTriangle));
  const RTCScene scene = new_scene(options);
  if (!user.triangles.empty()) {
    const EmbreeUserCallbacks callbacks = embree_user_callbacks();
    const RTCGeometry geometry = rtcNewGeometry(device_, RTC_GEOMETRY_TYPE_USER);
    rtcSetGeometryUserPrimitiveCount(geometry, static_cast<unsigned>(user.triangles.size()));
    rtcSetGeometryUserData(geometry, &user);
    rtcSetGeometryBoundsFunction(geometry, callbacks.bounds, nullptr);
    rtcSetGeometryIntersectFunction(geometry, callbacks.intersect);
    rtcSetGeometryOccludedFunction(geometry, callbacks.occluded);
    rtcSetGeometryBuildQuality(geometry, quality_of(options.quality));
    rtcCommitGeometry(geometry);
    rtcAttachGeometryByID(scene, geometry, 0);
    rtcReleaseGeometry(geometry);
  }
  rtcCommitScene(scene);
  check();
  return scene;
}

RTCScene EmbreeScene::commit_mesh(const Mesh& mesh, const EmbreeOptions& options, std::vector<std::uint32_t>& numbers) {
  if (options.geometry == EmbreeGeometry::user) return commit_user_mesh(mesh, options);
  std::vector<std::uint32_t> usable = usable_numbers(mesh);
  const RTCScene scene = new_scene(options);
  if (!usable.empty()) {
    const RTCGeometry geometry = rtcNewGeometry(device_, RTC_GEOMETRY_TYPE_TRIANGLE);
    void* vertices = rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, sizeof(Vec3),
                                             mesh.positions.size());
    void* indices =
        rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, sizeof(Triangle), usable.size());
    check();
    // Copies of the caller's mesh; the structure is what comes on top.
    bytes_ -= static_cast<std::ptrdiff_t>(mesh.positions.size() * sizeof(Vec3) + usable.size() * sizeof(Triangle));
    // In a scene of low quality each mesh is built as its own quality says, which is medium unless told.
    rtcSetGeometryBuildQuality(geometry, quality_of(options.quality));
    std::ranges::copy(mesh.positions, static_cast<Vec3*>(vertices));
    std::ranges::transform(usable, static_cast<Triangle*>(indices), [&](std::uint32_t i) { return mesh.triangles[i]; });
    rtcCommitGeometry(geometry);
    rtcAttachGeometryByID(scene, geometry, 0);
    rtcReleaseGeometry(geometry);
  }
  rtcCommitScene(scene);
  check();
  if (usable.size() < mesh.triangles.size()) numbers = std::move(usable);
  return scene;
}

void EmbreeScene::check() const {
  switch (rtcGetDeviceError(device_)) {
    case RTC_ERROR_NONE:
      return;
    case RTC_ERROR_OUT_OF_MEMORY:
      throw Error("Embree ran out of memory while building; use a smaller scene or a layout of Boxwood's own");
    default:
      throw Error("Embree failed to build this scene; use one of Boxwood's own layouts");
  }
}

}  // namespace boxwood
#endif
