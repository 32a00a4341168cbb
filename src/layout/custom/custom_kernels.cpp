// Rays walk to the leaves they meet, and bring what is there to the owner of the primitives: one ray leaf by leaf, rays
// of a batch together.
#include "layout/custom/custom_kernels.h"

#include "layout/simd/targets.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "layout/custom/custom_kernels.cpp"
#include <hwy/foreach_target.h>
//
#include <algorithm>
#include <cmath>
#include <limits>

#include "layout/encode.h"
#include "layout/wide/leaf_walk-inl.h"
#include "trace/triangle-inl.h"

HWY_BEFORE_NAMESPACE();
namespace boxwood {
namespace HWY_NAMESPACE {

/// Rays on their way at once, pairs of a ray and a primitive that are asked about at once, and open ends that a ray may
/// have; one that needs more goes alone.
inline constexpr std::uint32_t custom_rays = 256, custom_pairs = 512, custom_open_ends = 56;

HWY_INLINE bool is_hit(const CustomHit& hit, const Ray& ray) {
  return hit.t >= ray.t_near && hit.t <= ray.t_far && hit.t < std::numeric_limits<float>::infinity();
}

/// Asks about one ray and the primitives of a leaf; `on_hit(primitive, hit)` is told of those that it hits and says
/// whether that is enough.
template <class OnHit>
bool ask(const CustomLevel& level, const Ray& ray, const Link& leaf, OnHit on_hit) {
  constexpr std::uint32_t most = 16;
  Ray rays[most];
  CustomHit hits[most];
  for (std::uint32_t begin = 0; begin < leaf.count; begin += most) {
    const std::uint32_t count = std::min(most, leaf.count - begin);
    const std::uint32_t* primitives = level.primitives.data() + leaf.first + begin;
    std::fill_n(rays, count, ray);
    std::fill_n(hits, count, CustomHit{});
    level.owner->intersect({rays, count}, {primitives, count}, {hits, count});
    for (std::uint32_t i = 0; i < count; ++i) {
      if (is_hit(hits[i], ray) && on_hit(primitives[i], hits[i])) return true;
    }
  }
  return false;
}

template <int K, class CountingPolicy, class Limit, class OnLeaf>
HWY_INLINE void walk_alone(const CustomLevel& level, const Ray& ray, RayCounters* counters, Limit limit,
                           OnLeaf on_leaf) {
  CountingPolicy counting(counters);
  LeafWalk<K, stack_entries> walk;
  if (!walk.start(level.nodes, level.extent, ray, counting)) return;
  Link leaf;
  while (walk.next(level.nodes, limit(), leaf, counting) == LeafStep::visit) {
    for (std::uint32_t i = 0; i < leaf.count; ++i) counting.primitive();
    if (on_leaf(leaf)) return;
  }
}

template <int K, class CountingPolicy>
void closest_custom(const CustomLevel& level, const Ray& ray, std::uint32_t instance, Hit& best,
                    RayCounters* counters) {
  Ray rest = ray;
  const auto limit = [&] { return rest.t_far = best.t < ray.t_far ? best.t : ray.t_far; };
  walk_alone<K, CountingPolicy>(level, ray, counters, limit, [&](const Link& leaf) {
    return ask(level, rest, leaf, [&](std::uint32_t primitive, const CustomHit& hit) {
      if (wins(hit.t, instance, primitive, best)) best = {hit.t, hit.u, hit.v, primitive, instance};
      return false;
    });
  });
}

template <int K, class CountingPolicy>
bool any_custom(const CustomLevel& level, const Ray& ray, RayCounters* counters) {
  bool blocked = false;
  walk_alone<K, CountingPolicy>(
      level, ray, counters, [&] { return ray.t_far; },
      [&](const Link& leaf) {
        return blocked = ask(level, ray, leaf, [](std::uint32_t, const CustomHit&) { return true; });
      });
  return blocked;
}

/// Hits behind the first of a primitive are found by asking again from there on.
template <int K>
void offer_custom(const CustomLevel& level, const Ray& ray, std::uint32_t instance, HitSink& sink) {
  const auto limit = [&] { return sink.cutoff() < ray.t_far ? sink.cutoff() : ray.t_far; };
  walk_alone<K, NoCounting>(level, ray, nullptr, limit, [&](const Link& leaf) {
    return ask(level, ray, leaf, [&](std::uint32_t primitive, CustomHit hit) {
      Ray rest = ray;
      do {
        sink.offer({hit.t, hit.u, hit.v, primitive, instance});
        rest.t_near = std::nextafter(hit.t, std::numeric_limits<float>::infinity());
        hit = {};
        if (rest.t_near <= limit()) level.owner->intersect({&rest, 1}, {&primitive, 1}, {&hit, 1});
      } while (is_hit(hit, rest));
      return false;
    });
  });
}

/// `Query` keeps what has been found for the rays under way.
template <int K, class Query>
class CustomBatch {
 public:
  CustomBatch(const CustomLevel& level, Query& query) : level_(level), query_(query) {}

  void run(std::span<const Ray> rays) {
    for (std::size_t begin = 0; begin < rays.size(); begin += custom_rays) {
      run_some(rays.subspan(begin, std::min<std::size_t>(custom_rays, rays.size() - begin)), begin);
    }
  }

 private:
  void run_some(std::span<const Ray> rays, std::size_t begin) {
    NoCounting none(nullptr);
    query_.begin(rays, begin);
    std::uint32_t active = 0;
    for (std::uint32_t i = 0; i < rays.size(); ++i) {
      if (walks_[i].start(level_.nodes, level_.extent, rays[i], none)) active_[active++] = i;
    }
    while (active != 0) active = advance(rays, active);
  }

  /// Every ray goes on to its next leaf; then all that they came to is asked about.
  std::uint32_t advance(std::span<const Ray> rays, std::uint32_t active) {
    NoCounting none(nullptr);
    std::uint32_t left = 0;
    for (std::uint32_t a = 0; a < active; ++a) {
      const std::uint32_t i = active_[a];
      if (query_.finished(i)) continue;
      Link leaf;
      const LeafStep step = walks_[i].next(level_.nodes, query_.limit(i), leaf, none);
      if (step == LeafStep::overflow) query_.template alone<K>(level_, i);
      if (step != LeafStep::visit) continue;
      active_[left++] = i;
      for (std::uint32_t n = 0; n < leaf.count; ++n) add_pair(rays[i], i, level_.primitives[leaf.first + n]);
    }
    ask_about_pairs();
    return left;
  }

  HWY_INLINE void add_pair(const Ray& ray, std::uint32_t number, std::uint32_t primitive) {
    ray_of_[pairs_] = number;
    rays_[pairs_] = ray;
    rays_[pairs_].t_far = query_.limit(number);
    primitives_[pairs_] = primitive;
    if (++pairs_ == custom_pairs) ask_about_pairs();
  }

  void ask_about_pairs() {
    const std::uint32_t count = pairs_;
    pairs_ = 0;
    if (count == 0) return;
    std::fill_n(hits_, count, CustomHit{});
    level_.owner->intersect({rays_, count}, {primitives_, count}, {hits_, count});
    for (std::uint32_t i = 0; i < count; ++i) {
      if (is_hit(hits_[i], rays_[i])) query_.take(ray_of_[i], primitives_[i], hits_[i]);
    }
  }

  const CustomLevel& level_;
  Query& query_;
  std::uint32_t active_[custom_rays];
  std::uint32_t pairs_ = 0;
  std::uint32_t ray_of_[custom_pairs], primitives_[custom_pairs];
  Ray rays_[custom_pairs];
  CustomHit hits_[custom_pairs];
  LeafWalk<K, custom_open_ends> walks_[custom_rays];
};

class ClosestCustom {
 public:
  explicit ClosestCustom(std::span<Hit> hits) : all_hits_(hits) {}

  void begin(std::span<const Ray> rays, std::size_t first) {
    rays_ = rays.data();
    hits_ = all_hits_.data() + first;
    std::fill_n(hits_, rays.size(), Hit{});
  }
  static bool finished(std::uint32_t) { return false; }
  HWY_INLINE float limit(std::uint32_t i) const { return hits_[i].t < rays_[i].t_far ? hits_[i].t : rays_[i].t_far; }
  HWY_INLINE void take(std::uint32_t i, std::uint32_t primitive, const CustomHit& hit) {
    if (wins(hit.t, 0, primitive, hits_[i])) hits_[i] = {hit.t, hit.u, hit.v, primitive, 0};
  }
  template <int K>
  void alone(const CustomLevel& level, std::uint32_t i) {
    closest_custom<K, NoCounting>(level, rays_[i], 0, hits_[i], nullptr);
  }

 private:
  std::span<Hit> all_hits_;
  const Ray* rays_ = nullptr;
  Hit* hits_ = nullptr;
};

class AnyCustom {
 public:
  explicit AnyCustom(std::span<std::uint8_t> blocked) : all_blocked_(blocked) {}

  void begin(std::span<const Ray> rays, std::size_t first) {
    rays_ = rays.data();
    blocked_ = all_blocked_.data() + first;
    std::fill_n(blocked_, rays.size(), std::uint8_t{0});
  }
  HWY_INLINE bool finished(std::uint32_t i) const { return blocked_[i] != 0; }
  HWY_INLINE float limit(std::uint32_t i) const { return rays_[i].t_far; }
  HWY_INLINE void take(std::uint32_t i, std::uint32_t, const CustomHit&) { blocked_[i] = 1; }
  template <int K>
  void alone(const CustomLevel& level, std::uint32_t i) {
    blocked_[i] = any_custom<K, NoCounting>(level, rays_[i], nullptr) ? 1 : 0;
  }

 private:
  std::span<std::uint8_t> all_blocked_;
  const Ray* rays_ = nullptr;
  std::uint8_t* blocked_ = nullptr;
};

template <int K>
struct CustomKernelsOf {
  static void closest(const CustomLevel& level, const Ray& ray, std::uint32_t instance, Hit& best,
                      RayCounters* counters) {
    if (counters) return closest_custom<K, Counting>(level, ray, instance, best, counters);
    closest_custom<K, NoCounting>(level, ray, instance, best, nullptr);
  }
  static bool any(const CustomLevel& level, const Ray& ray, RayCounters* counters) {
    return counters ? any_custom<K, Counting>(level, ray, counters) : any_custom<K, NoCounting>(level, ray, nullptr);
  }
  static void closest_batch(const CustomLevel& level, std::span<const Ray> rays, std::span<Hit> hits) {
    ClosestCustom query(hits);
    CustomBatch<K, ClosestCustom>(level, query).run(rays);
  }
  static void any_batch(const CustomLevel& level, std::span<const Ray> rays, std::span<std::uint8_t> blocked) {
    AnyCustom query(blocked);
    CustomBatch<K, AnyCustom>(level, query).run(rays);
  }
  static CustomKernels table() { return {closest, any, offer_custom<K>, closest_batch, any_batch}; }
};

CustomKernels choose_custom(std::uint32_t k) {
  return k == 4 ? CustomKernelsOf<4>::table() : k == 8 ? CustomKernelsOf<8>::table() : CustomKernelsOf<16>::table();
}

}  // namespace HWY_NAMESPACE
}  // namespace boxwood
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace boxwood {

HWY_EXPORT(choose_custom);

CustomKernels custom_kernels(std::uint32_t k) { return HWY_DYNAMIC_DISPATCH(choose_custom)(k); }

}  // namespace boxwood
#endif
