// Embree 3 as a user would call it: every call it has for many rays, on triangles copied into its own buffers.
#pragma once
#ifdef BOXWOOD_EMBREE
#include <embree3/rtcore.h>

#include <array>
#include <cstddef>
#include <span>
#include <string_view>

#include "boxwood/ray_set.h"
#include "boxwood/scene.h"
#include "measure/clock.h"

namespace boxwood::cli {

enum class EmbreeCall { single, packet4, packet8, packet16, stream };

inline constexpr std::array<std::string_view, 5> embree_call_names = {"single", "packet4", "packet8", "packet16",
                                                                      "stream"};

/// One mesh, built with one quality, not robust. Throws Error when Embree refuses.
class EmbreeScene {
 public:
  EmbreeScene(RTCDevice device, const Mesh& mesh, RTCBuildQuality quality, Clock clock = Clock::wall);
  ~EmbreeScene() { rtcReleaseScene(scene_); }
  EmbreeScene(const EmbreeScene&) = delete;
  EmbreeScene& operator=(const EmbreeScene&) = delete;

  /// Rays [begin, end) of `set`, its structures filled and read on the way: t[i] is the distance of ray i's hit, its
  /// t_far on a miss; of any-hit rays -infinity when blocked.
  void trace(const RaySet& set, std::size_t begin, std::size_t end, EmbreeCall call, std::span<float> t) const;

  /// What committing took, by the clock, once the triangles were in Embree's buffers.
  double build_seconds() const { return build_seconds_; }

 private:
  RTCScene scene_;
  double build_seconds_ = 0;
};

}  // namespace boxwood::cli
#endif
