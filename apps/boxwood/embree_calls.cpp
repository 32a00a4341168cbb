#include "embree_calls.h"

#ifdef BOXWOOD_EMBREE
#include <algorithm>
#include <vector>

#include "boxwood/error.h"

namespace boxwood::cli {
namespace {

RTCRay convert(const Ray& ray) {
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

template <class Packet>
auto& ray_part(Packet& packet) {
  if constexpr (requires { packet.ray; })
    return packet.ray;
  else
    return packet;
}

/// No hit yet.
template <class Packet>
void clear(Packet& packet) {
  if constexpr (requires { packet.hit; }) {
    packet.hit.geomID = RTC_INVALID_GEOMETRY_ID;
    packet.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
  }
}

template <class Single, class Function>
void trace_singles(std::span<const Ray> rays, std::span<float> t, Function call) {
  for (std::size_t i = 0; i < rays.size(); ++i) {
    Single single;
    ray_part(single) = convert(rays[i]);
    clear(single);
    call(&single);
    t[i] = ray_part(single).tfar;
  }
}

template <class Packet, std::size_t Width, class Function>
void trace_packets(std::span<const Ray> rays, std::span<float> t, Function call) {
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
    call(valid, &packet);
    for (std::size_t i = 0; i < std::min(Width, rays.size() - begin); ++i) t[begin + i] = part.tfar[i];
  }
}

template <class Single, class Function>
void trace_streams(std::span<const Ray> rays, std::span<float> t, Function call) {
  constexpr std::size_t length = 4096;
  thread_local std::vector<Single> buffer(length);
  for (std::size_t begin = 0; begin < rays.size(); begin += length) {
    const std::size_t count = std::min(length, rays.size() - begin);
    for (std::size_t i = 0; i < count; ++i) {
      ray_part(buffer[i]) = convert(rays[begin + i]);
      clear(buffer[i]);
    }
    call(buffer.data(), static_cast<unsigned>(count));
    for (std::size_t i = 0; i < count; ++i) t[begin + i] = ray_part(buffer[i]).tfar;
  }
}

void trace_closest(RTCScene scene, RTCIntersectContext* context, EmbreeCall call, std::span<const Ray> rays,
                   std::span<float> t) {
  switch (call) {
    case EmbreeCall::single:
      return trace_singles<RTCRayHit>(rays, t, [&](RTCRayHit* ray) { rtcIntersect1(scene, context, ray); });
    case EmbreeCall::packet4:
      return trace_packets<RTCRayHit4, 4>(
          rays, t, [&](const int* valid, auto* packet) { rtcIntersect4(valid, scene, context, packet); });
    case EmbreeCall::packet8:
      return trace_packets<RTCRayHit8, 8>(
          rays, t, [&](const int* valid, auto* packet) { rtcIntersect8(valid, scene, context, packet); });
    case EmbreeCall::packet16:
      return trace_packets<RTCRayHit16, 16>(
          rays, t, [&](const int* valid, auto* packet) { rtcIntersect16(valid, scene, context, packet); });
    case EmbreeCall::stream:
      return trace_streams<RTCRayHit>(rays, t, [&](RTCRayHit* first, unsigned count) {
        rtcIntersect1M(scene, context, first, count, sizeof(RTCRayHit));
      });
  }
}

void trace_any(RTCScene scene, RTCIntersectContext* context, EmbreeCall call, std::span<const Ray> rays,
               std::span<float> t) {
  switch (call) {
    case EmbreeCall::single:
      return trace_singles<RTCRay>(rays, t, [&](RTCRay* ray) { rtcOccluded1(scene, context, ray); });
    case EmbreeCall::packet4:
      return trace_packets<RTCRay4, 4>(
          rays, t, [&](const int* valid, auto* packet) { rtcOccluded4(valid, scene, context, packet); });
    case EmbreeCall::packet8:
      return trace_packets<RTCRay8, 8>(
          rays, t, [&](const int* valid, auto* packet) { rtcOccluded8(valid, scene, context, packet); });
    case EmbreeCall::packet16:
      return trace_packets<RTCRay16, 16>(
          rays, t, [&](const int* valid, auto* packet) { rtcOccluded16(valid, scene, context, packet); });
    case EmbreeCall::stream:
      return trace_streams<RTCRay>(
          rays, t, [&](RTCRay* first, unsigned count) { rtcOccluded1M(scene, context, first, count, sizeof(RTCRay)); });
  }
}

}  // namespace

EmbreeScene::EmbreeScene(RTCDevice device, const Mesh& mesh, RTCBuildQuality quality, Clock clock)
    : scene_(rtcNewScene(device)) {
  rtcSetSceneBuildQuality(scene_, quality);
  RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
  rtcSetGeometryBuildQuality(geometry, quality);
  void* positions = rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, sizeof(Vec3),
                                            mesh.positions.size());
  void* triangles = rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, sizeof(Triangle),
                                            mesh.triangles.size());
  if (positions && triangles) {
    std::ranges::copy(mesh.positions, static_cast<Vec3*>(positions));
    std::ranges::copy(mesh.triangles, static_cast<Triangle*>(triangles));
    rtcAttachGeometry(scene_, geometry);
  }
  const double begin = now(clock);
  rtcCommitGeometry(geometry);
  rtcCommitScene(scene_);
  build_seconds_ = now(clock) - begin;
  rtcReleaseGeometry(geometry);
  if (rtcGetDeviceError(device) != RTC_ERROR_NONE) {
    rtcReleaseScene(scene_);
    throw Error("Embree could not build the scene, most likely for lack of memory; take a smaller one");
  }
}

void EmbreeScene::trace(const RaySet& set, std::size_t begin, std::size_t end, EmbreeCall call,
                        std::span<float> t) const {
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  context.flags = set.kind == "primary" ? RTC_INTERSECT_CONTEXT_FLAG_COHERENT : RTC_INTERSECT_CONTEXT_FLAG_INCOHERENT;
  const auto rays = std::span(set.rays).subspan(begin, end - begin);
  const auto trace_part = set.query == Query::closest_hit ? trace_closest : trace_any;
  trace_part(scene_, &context, call, rays, t.subspan(begin, end - begin));
}

}  // namespace boxwood::cli
#endif
