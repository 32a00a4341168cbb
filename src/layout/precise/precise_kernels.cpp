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
#include <cstddef>
#include <optional>

#include "layout/encode.h"
#include "layout/wide/leaf_walk-inl.h"
#include "trace/precise_ray-inl.h"

HWY_BEFORE_NAMESPACE();
namespace boxwood {
namespace HWY_NAMESPACE {

/// Open ends that a walk through a frame has room for before the ray begins anew with room for any tree.
inline constexpr std::uint32_t usual_open_ends = 56;

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
  MovedRay() = default;
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

/// The closest-hit query of one ray.
template <class CountingPolicy>
class PreciseClosest {
 public:
  using Answer = PreciseHit;

  PreciseClosest(const PreciseRay& ray, PreciseHit& best, RayCounters* counters)
      : counting(counters), sheared_(shear(ray)), best_(&best) {}

  HWY_INLINE double limit() const { return best_->t < sheared_.t_far ? best_->t : sheared_.t_far; }
  /// Whether the triangle ends the walk.
  HWY_INLINE bool operator()(const PreciseTriangle& triangle) {
    closest_of(triangle, sheared_, *best_);
    return false;
  }

  CountingPolicy counting;

 private:
  PreciseSheared sheared_;
  PreciseHit* best_;
};

template <class CountingPolicy>
class PreciseAny {
 public:
  using Answer = std::uint8_t;

  PreciseAny(const PreciseRay& ray, std::uint8_t& blocked, RayCounters* counters)
      : counting(counters), sheared_(shear(ray)), blocked_(&blocked) {}

  HWY_INLINE double limit() const { return sheared_.t_far; }
  HWY_INLINE bool operator()(const PreciseTriangle& triangle) {
    *blocked_ = blocks(triangle, sheared_) ? 1 : 0;
    return *blocked_ != 0;
  }

  CountingPolicy counting;

 private:
  PreciseSheared sheared_;
  std::uint8_t* blocked_;
};

/// One ray on its way through frames within frames, leaf by leaf, with room for `open_ends` in each.
template <int K, std::uint32_t open_ends, class Visit>
class PreciseWalk {
 public:
  PreciseWalk(const PreciseLevel& level, const PreciseRay& ray, Visit& visit) : ray_(ray, level.reach) {
    if (!level.frames.empty()) enter(level.frames[0], visit);
  }

  /// Goes through what the ray has come to and on to the next leaf. When that is `visit`, the leaf is on its way from
  /// memory, and other work may be done meanwhile.
  HWY_INLINE LeafStep advance(const PreciseLevel& level, Visit& visit) {
    while (depth_ != 0) {
      Within& within = within_[depth_ - 1];
      const PreciseFrame& frame = *within.frame;
      if (within.left.count == 0) {
        const LeafStep step =
            within.walk.next(frame.nodes, within.moved.local(visit.limit()), within.left, visit.counting);
        if (step == LeafStep::overflow) return step;
        if (step == LeafStep::visit) {
          prefetch(level.entries.data() + frame.first_entry + within.left.first, within.left.count);
          return step;
        }
        --depth_;
        continue;
      }
      --within.left.count;
      const PreciseTriangle& entry = level.entries[frame.first_entry + within.left.first++];
      if (entry.frame != no_frame) {
        enter(level.frames[entry.frame], visit);
        continue;
      }
      visit.counting.primitive();
      if (visit(entry)) return LeafStep::done;
    }
    return LeafStep::done;
  }

 private:
  struct Within {
    const PreciseFrame* frame;
    MovedRay moved;
    LeafWalk<K, open_ends> walk;
    Link left;  ///< of the leaf that is being visited
  };

  void enter(const PreciseFrame& frame, Visit& visit) {
    Within& within = within_[depth_];
    within.frame = &frame;
    within.moved = MovedRay(frame, ray_);
    within.left.count = 0;
    if (within.moved.passes_by()) return;
    if (within.walk.start(frame.nodes, within.moved.reach(), within.moved.ray(), visit.counting)) ++depth_;
  }
  static HWY_INLINE void prefetch(const PreciseTriangle* entry, std::uint32_t count) {
    const auto* const begin = reinterpret_cast<const std::byte*>(entry);
    for (std::size_t at = 0; at < count * sizeof(PreciseTriangle); at += 64) __builtin_prefetch(begin + at);
  }

  PreciseWalkRay ray_;
  std::uint32_t depth_ = 0;
  Within within_[most_frames_deep];
};

/// Whatever its depth.
template <int K, class Visit>
HWY_NOINLINE void walk_deep(const PreciseLevel& level, const PreciseRay& ray, Visit& visit) {
  PreciseWalk<K, stack_entries, Visit> walk(level, ray, visit);
  while (walk.advance(level, visit) == LeafStep::visit) {
  }
}

template <int K, class Visit>
typename Visit::Answer trace_precise(const PreciseLevel& level, const PreciseRay& ray, RayCounters* counters) {
  typename Visit::Answer answer{};
  if (!within_limits(ray)) return answer;
  Visit visit(ray, answer, counters);
  PreciseWalk<K, usual_open_ends, Visit> walk(level, ray, visit);
  LeafStep step;
  do {
    step = walk.advance(level, visit);
  } while (step == LeafStep::visit);
  if (HWY_UNLIKELY(step == LeafStep::overflow)) walk_deep<K>(level, ray, visit);
  return answer;
}

/// Some rays at once in turn: while memory brings the leaf of one, others go on.
template <int K, class Visit>
class PreciseBatch {
  using Answer = typename Visit::Answer;

 public:
  PreciseBatch(const PreciseLevel& level, std::span<const PreciseRay> rays, std::span<Answer> answers)
      : level_(level), rays_(rays), answers_(answers) {}

  void run() {
    std::uint32_t active = 0;
    while (active < together && load(slots_[active])) ++active;
    while (active != 0) {
      for (std::uint32_t i = 0; i < active;) {
        Slot& slot = slots_[i];
        const LeafStep step = slot->walk.advance(level_, slot->visit);
        if (HWY_UNLIKELY(step == LeafStep::overflow)) walk_deep<K>(level_, rays_[slot->number], slot->visit);
        if (step == LeafStep::visit || load(slot)) {
          ++i;
        } else {
          slot = slots_[--active];
        }
      }
    }
  }

 private:
  static constexpr std::uint32_t together = 12;

  struct UnderWay {
    UnderWay(const PreciseLevel& level, const PreciseRay& ray, Answer& answer, std::size_t n)
        : number(n), visit(ray, answer, nullptr), walk(level, ray, visit) {}
    std::size_t number;
    Visit visit;
    PreciseWalk<K, usual_open_ends, Visit> walk;
  };
  using Slot = std::optional<UnderWay>;

  /// False when there is no ray left.
  bool load(Slot& slot) {
    for (; next_ < rays_.size(); ++next_) {
      answers_[next_] = {};
      if (!within_limits(rays_[next_])) continue;
      slot.emplace(level_, rays_[next_], answers_[next_], next_);
      ++next_;
      return true;
    }
    return false;
  }

  const PreciseLevel& level_;
  std::span<const PreciseRay> rays_;
  std::span<Answer> answers_;
  std::size_t next_ = 0;
  Slot slots_[together];
};

template <int K>
struct PreciseKernelsOf {
  static PreciseHit closest(const PreciseLevel& level, const PreciseRay& ray, RayCounters* counters) {
    return counters ? trace_precise<K, PreciseClosest<Counting>>(level, ray, counters)
                    : trace_precise<K, PreciseClosest<NoCounting>>(level, ray, nullptr);
  }
  static bool any(const PreciseLevel& level, const PreciseRay& ray, RayCounters* counters) {
    return (counters ? trace_precise<K, PreciseAny<Counting>>(level, ray, counters)
                     : trace_precise<K, PreciseAny<NoCounting>>(level, ray, nullptr)) != 0;
  }
  static void closest_batch(const PreciseLevel& level, std::span<const PreciseRay> rays, std::span<PreciseHit> hits) {
    PreciseBatch<K, PreciseClosest<NoCounting>>(level, rays, hits).run();
  }
  static void any_batch(const PreciseLevel& level, std::span<const PreciseRay> rays, std::span<std::uint8_t> blocked) {
    PreciseBatch<K, PreciseAny<NoCounting>>(level, rays, blocked).run();
  }
  static constexpr PreciseKernels table{closest, any, closest_batch, any_batch};
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
