// Rays in double precision through frames of single-precision boxes.
//
// A ray is moved into each frame it comes to: its origin to where it is nearest to the frame's centre, in double, and
// only then rounded. What is rounded lies near the frame, so it is off by 2^-24 of the frame's size, like the boxes.
#include "layout/precise/precise_kernels.h"

#include "layout/simd/targets.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "layout/precise/precise_kernels.cpp"
#include <hwy/foreach_target.h>
//
#include <cmath>

#include "layout/encode.h"
#include "layout/wide/leaf_walk-inl.h"
#include "trace/precise_ray-inl.h"

HWY_BEFORE_NAMESPACE();
namespace boxwood {
namespace HWY_NAMESPACE {

/// Open ends that a walk through a frame has room for before it begins anew with room for any tree.
inline constexpr std::uint32_t usual_open_ends = 128;

/// What all frames need of a ray.
struct PreciseWalkRay {
  DoubleVec3 origin, direction;
  double inverse_square;  ///< 1 / |direction|^2
  double unit;            ///< power of two: t times it counts in units of `rounded`
  Vec3 rounded;           ///< the direction over `unit`, its largest component in [1, 2]
  double magnitude;       ///< largest coordinate that the triangle test handles
  double t_near, t_far;

  PreciseWalkRay(const PreciseRay& ray, double reach) : origin(ray.origin), direction(ray.direction) {
    double square = 0;
    for (std::size_t axis = 0; axis < 3; ++axis) square = fused(direction[axis], direction[axis], square);
    inverse_square = 1 / square;
    unit = std::ldexp(1.0, std::ilogb(largest_of(direction)));
    for (std::size_t axis = 0; axis < 3; ++axis) rounded[axis] = static_cast<float>(direction[axis] / unit);
    // Below 2^-420 the triangle test's products leave the range of normal doubles; its errors are then absolute.
    magnitude = std::fmax(largest_of(origin) + reach, 0x1p-420);
    t_near = ray.t_near;
    t_far = ray.t_far;
  }
};

/// A ray in the space of a frame.
class MovedRay {
 public:
  /// Seen from so many times its size, which may be all that a double tells from nothing, a frame is entered in full.
  static constexpr float blurred_reach = 0x1p36f;

  /// Its box test's bound, 2^-19 of `reach` and the moved origin, has to cover what is rounded to floats: 2^-24 of them
  /// each for boxes, origin, direction and limits of t, and 11 * 2^-24 for the box test itself. And what is rounded to
  /// doubles: 17 * 2^-53 of the largest coordinates by the triangle test (see docs/architecture.md), as much again by
  /// moving the ray. 2^-28 of them, added to `reach`, makes 64 * 2^-53.
  HWY_INLINE MovedRay(const PreciseFrame& frame, const PreciseWalkRay& ray) {
    double along = 0;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      along = fused(frame.center[axis] - ray.origin[axis], ray.direction[axis], along);
    }
    t_moved_ = along * ray.inverse_square;
    t_scale_ = ray.unit * frame.scale;
    const double reach = static_cast<double>(frame.reach) + ray.magnitude * 0x1p-28 * frame.scale;
    blurred_ = reach > blurred_reach;
    reach_ = blurred_ ? blurred_reach : static_cast<float>(reach);
    float farthest = 0;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const double at = fused(t_moved_, ray.direction[axis], ray.origin[axis]) - frame.center[axis];
      ray_.origin[axis] = blurred_ ? 0 : static_cast<float>(at * frame.scale);
      farthest = std::fmax(farthest, std::fabs(ray_.origin[axis]));
    }
    // Even the point nearest to the centre is outside the sphere around all boxes.
    passes_by_ = farthest > 4 * reach_;
    ray_.direction = ray.rounded;
    ray_.t_near = local(ray.t_near);
    ray_.t_far = local(ray.t_far);
  }

  HWY_INLINE float local(double t) const {
    return HWY_UNLIKELY(blurred_) ? 0 : static_cast<float>((t - t_moved_) * t_scale_);
  }
  bool passes_by() const { return passes_by_; }
  const Ray& ray() const { return ray_; }
  Reach reach() const { return {reach_, 1}; }

 private:
  Ray ray_;
  double t_moved_, t_scale_;
  float reach_;
  bool passes_by_, blurred_;
};

template <class CountingPolicy>
struct PreciseClosestVisit {
  const PreciseSheared& sheared;
  PreciseHit& best;
  CountingPolicy counting;

  HWY_INLINE double limit() const { return best.t < sheared.t_far ? best.t : sheared.t_far; }
  HWY_INLINE bool operator()(const PreciseTriangle& triangle) {
    closest_of(triangle, sheared, best);
    return false;
  }
};

template <class CountingPolicy>
struct PreciseAnyVisit {
  const PreciseSheared& sheared;
  CountingPolicy counting;

  HWY_INLINE double limit() const { return sheared.t_far; }
  HWY_INLINE bool operator()(const PreciseTriangle& triangle) const { return blocks(triangle, sheared); }
};

enum class FrameEnd : std::uint8_t { stopped, done, overflow };

/// `visit` says whether a triangle is enough.
template <int K, class Visit>
class PreciseWalk {
 public:
  PreciseWalk(const PreciseLevel& level, const PreciseRay& ray, Visit& visit)
      : level_(level), ray_(ray, level.reach), visit_(visit) {}

  bool run() { return !level_.frames.empty() && enter(0); }

 private:
  bool enter(std::uint32_t frame) {
    FrameEnd end = walk_frame<usual_open_ends>(level_.frames[frame]);
    if (HWY_UNLIKELY(end == FrameEnd::overflow)) end = walk_deep_frame(level_.frames[frame]);
    return end == FrameEnd::stopped;
  }

  HWY_NOINLINE FrameEnd walk_deep_frame(const PreciseFrame& frame) { return walk_frame<stack_entries>(frame); }

  template <std::uint32_t open_ends>
  FrameEnd walk_frame(const PreciseFrame& frame) {
    const MovedRay moved(frame, ray_);
    if (moved.passes_by()) return FrameEnd::done;
    LeafWalk<K, open_ends> walk;
    if (!walk.start(frame.nodes, moved.reach(), moved.ray(), visit_.counting)) return FrameEnd::done;
    const PreciseTriangle* const entries = level_.entries.data() + frame.first_entry;
    Link leaf;
    LeafStep step;
    while ((step = walk.next(frame.nodes, moved.local(visit_.limit()), leaf, visit_.counting)) == LeafStep::visit) {
      for (const PreciseTriangle *entry = entries + leaf.first, *end = entry + leaf.count; entry != end; ++entry) {
        if (entry->frame == no_frame) visit_.counting.primitive();
        if (entry->frame == no_frame ? visit_(*entry) : enter(entry->frame)) return FrameEnd::stopped;
      }
    }
    return step == LeafStep::overflow ? FrameEnd::overflow : FrameEnd::done;
  }

  const PreciseLevel& level_;
  const PreciseWalkRay ray_;
  Visit& visit_;
};

template <int K, class CountingPolicy>
PreciseHit closest_precise(const PreciseLevel& level, const PreciseRay& ray, RayCounters* counters) {
  PreciseHit best;
  if (!within_limits(ray)) return best;
  const PreciseSheared sheared = shear(ray);
  PreciseClosestVisit<CountingPolicy> visit{sheared, best, CountingPolicy(counters)};
  PreciseWalk<K, decltype(visit)>(level, ray, visit).run();
  return best;
}

template <int K, class CountingPolicy>
bool any_precise(const PreciseLevel& level, const PreciseRay& ray, RayCounters* counters) {
  if (!within_limits(ray)) return false;
  const PreciseSheared sheared = shear(ray);
  PreciseAnyVisit<CountingPolicy> visit{sheared, CountingPolicy(counters)};
  return PreciseWalk<K, decltype(visit)>(level, ray, visit).run();
}

template <int K>
struct PreciseKernelsOf {
  static PreciseHit closest(const PreciseLevel& level, const PreciseRay& ray, RayCounters* counters) {
    return counters ? closest_precise<K, Counting>(level, ray, counters)
                    : closest_precise<K, NoCounting>(level, ray, nullptr);
  }
  static bool any(const PreciseLevel& level, const PreciseRay& ray, RayCounters* counters) {
    return counters ? any_precise<K, Counting>(level, ray, counters) : any_precise<K, NoCounting>(level, ray, nullptr);
  }
  static constexpr PreciseKernels table{closest, any};
};

const PreciseKernels* choose_precise(std::uint32_t k) {
  return k == 4 ? &PreciseKernelsOf<4>::table : k == 8 ? &PreciseKernelsOf<8>::table : &PreciseKernelsOf<16>::table;
}

}  // namespace HWY_NAMESPACE
}  // namespace boxwood
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace boxwood {

HWY_EXPORT(choose_precise);

const PreciseKernels* precise_kernels(std::uint32_t k) { return HWY_DYNAMIC_DISPATCH(choose_precise)(k); }

}  // namespace boxwood
#endif
