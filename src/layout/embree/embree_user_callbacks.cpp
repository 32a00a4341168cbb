#ifdef BOXWOOD_EMBREE
#include "trace/scalar_targets.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "layout/embree/embree_user_callbacks.cpp"
#include <hwy/foreach_target.h>
//
#include <cstring>

#include "layout/embree/embree_user.h"
#include "trace/object_ray.h"
#include "trace/triangle-inl.h"

HWY_BEFORE_NAMESPACE();
namespace boxwood {
namespace HWY_NAMESPACE {

/// The ray as the instance that is being visited sees it. Our own transform gives the bits of our other layouts.
HWY_INLINE PreparedRay ray_at(EmbreeUserQuery& query, std::uint32_t instance) {
  static_assert(sizeof(PreparedRay) <= sizeof query.prepared);
  PreparedRay ray;
  if (query.prepared_for != instance) {
    const bool placed = instance != RTC_INVALID_GEOMETRY_ID;
    ray = prepare(placed ? object_ray(query.world_to_object[instance], query.ray) : query.ray, 0);
    std::memcpy(query.prepared, &ray, sizeof ray);
    query.prepared_for = instance;
    return ray;
  }
  std::memcpy(&ray, query.prepared, sizeof ray);
  return ray;
}

// Single rays only, so N is 1 and the ray lies there as RTCRayHit.

void intersect_user(const RTCIntersectFunctionNArguments* args) {
  auto& query = *reinterpret_cast<EmbreeUserQuery*>(args->context);
  auto& hit = *reinterpret_cast<RTCRayHit*>(args->rayhit);
  const std::uint32_t instance = args->context->instID[0];
  const PreparedRay ray = ray_at(query, instance);
  ++query.tests;
  const auto& mesh = *static_cast<const EmbreeUserMesh*>(args->geometryUserPtr);
  if (!ray.valid) return;
  if (!closest_of(mesh.triangles[args->primID], ray, instance == RTC_INVALID_GEOMETRY_ID ? 0 : instance, query.best)) {
    return;
  }
  hit.ray.tfar = query.best.t;
  hit.hit.geomID = args->geomID;
  hit.hit.primID = args->primID;
  hit.hit.instID[0] = instance;
}

void occluded_user(const RTCOccludedFunctionNArguments* args) {
  auto& query = *reinterpret_cast<EmbreeUserQuery*>(args->context);
  const PreparedRay ray = ray_at(query, args->context->instID[0]);
  ++query.tests;
  const auto& mesh = *static_cast<const EmbreeUserMesh*>(args->geometryUserPtr);
  if (ray.valid && blocks(mesh.triangles[args->primID], ray)) {
    reinterpret_cast<RTCRay*>(args->ray)->tfar = -std::numeric_limits<float>::infinity();
  }
}

EmbreeUserCallbacks choose_user_callbacks() { return {nullptr, intersect_user, occluded_user}; }

}  // namespace HWY_NAMESPACE
}  // namespace boxwood
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace boxwood {
namespace {

/// Wider by what the box test of our own layouts allows for, which Embree's does not know.
void bounds_user(const RTCBoundsFunctionArguments* args) {
  const auto& mesh = *static_cast<const EmbreeUserMesh*>(args->geometryUserPtr);
  const LeafTriangle& triangle = mesh.triangles[args->primID];
  Box box;
  for (const Vec3& corner : {triangle.a, triangle.b, triangle.c}) box.grow(corner);
  const float margin = mesh.reach * 0x1p-19f;
  RTCBounds& out = *args->bounds_o;
  out.lower_x = box.lower.x - margin, out.upper_x = box.upper.x + margin;
  out.lower_y = box.lower.y - margin, out.upper_y = box.upper.y + margin;
  out.lower_z = box.lower.z - margin, out.upper_z = box.upper.z + margin;
}

}  // namespace

HWY_EXPORT(choose_user_callbacks);

EmbreeUserCallbacks embree_user_callbacks() {
  EmbreeUserCallbacks callbacks = HWY_DYNAMIC_DISPATCH(choose_user_callbacks)();
  callbacks.bounds = bounds_user;
  return callbacks;
}

}  // namespace boxwood
#endif
#endif
