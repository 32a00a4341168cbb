#pragma once
// Embree's tree around our triangle test, as spec 004 compares: what it costs above our own layouts is topology.
#include <embree3/rtcore.h>

#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

#include "boxwood/ray.h"
#include "boxwood/scene.h"
#include "boxwood/transform.h"
#include "layout/layout.h"
#include "trace/leaf_triangle.h"

namespace boxwood {

struct EmbreeOptions;

/// The user data of a geometry.
struct EmbreeUserMesh {
  std::vector<LeafTriangle> triangles;
  float reach = 0;  ///< largest absolute coordinate
};

/// One query, from which Embree hands its first member to every callback.
struct EmbreeUserQuery {
  static constexpr std::uint32_t nowhere = 0xfffffffe;

  RTCIntersectContext context;
  Ray ray;                                     ///< in world space
  const Transform* world_to_object = nullptr;  ///< per instance
  Hit best;
  std::uint32_t tests = 0;
  std::uint32_t prepared_for = nowhere;  ///< Embree's number of the instance that `prepared` is for
  alignas(16) std::byte prepared[128];   ///< a PreparedRay of the callbacks' instruction set
};

struct EmbreeUserCallbacks {
  RTCBoundsFunction bounds;
  RTCIntersectFunctionN intersect;
  RTCOccludedFunctionN occluded;
};

/// Compiled for the instruction set of this machine.
EmbreeUserCallbacks embree_user_callbacks();

/// Traces single rays. Counts the triangles tested, nothing else.
std::shared_ptr<const Layout> make_embree_user_layout(const Scene& scene, const EmbreeOptions& options);

}  // namespace boxwood
